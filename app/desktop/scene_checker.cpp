#include "app/desktop/scene_checker.h"

#include "app/desktop/background.h"
#include "sim/base/error.h"
#include "sim/run/preview.h"

#include <filesystem>

namespace sandglass::desktop {

namespace {

constexpr int nice = 3;

void note(QStringList& faults, const std::exception& e) {
  if (const auto* input = dynamic_cast<const InputError*>(&e)) {
    for (const auto& sentence : input->sentences())
      faults << QString::fromStdString(sentence);
  } else {
    faults << QString::fromUtf8(e.what());
  }
}

} // namespace

SceneChecker::SceneChecker() : thread_([this] { work(); }) {}

SceneChecker::~SceneChecker() {
  in_.close();
  thread_.join();
}

void SceneChecker::check(const QString& text, const QString& file, bool preview) {
  in_.put({text, file, preview, ++asked_});
}

std::optional<SceneChecker::Outcome> SceneChecker::take() {
  auto outcome = out_.take();
  if (outcome) taken_ = outcome->number;
  return outcome;
}

void SceneChecker::work() {
  lowerPriority(nice);
  while (const auto order = in_.wait()) {
    Outcome outcome;
    outcome.text = order->text;
    outcome.number = order->number;
    try {
      const std::filesystem::path file = order->file.toStdString();
      const auto folder = file.parent_path();
      outcome.scene = parseScene(order->text.toStdString(), file.filename().string(), {},
                                 folder.empty() ? "." : folder.string());
      outcome.scene->file = file.string();
      outcome.resolved = QString::fromStdString(writeScene(*outcome.scene));
    } catch (const std::exception& e) {
      note(outcome.faults, e);
    }
    if (outcome.scene && order->preview && order->number == asked_) {
      try {
        outcome.preview = previewFrame(*outcome.scene, mostPreviewGrains);
      } catch (const std::exception& e) {
        note(outcome.faults, e);
      }
    }
    out_.put(std::move(outcome));
    done_ = order->number;
    Q_EMIT ready();
  }
}

} // namespace sandglass::desktop
