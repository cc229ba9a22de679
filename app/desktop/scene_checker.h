#pragma once
// Reads and checks the text of a scene while somebody edits it, and prepares what it looks like, in a thread
// of its own; the newest text wins.

#include "app/desktop/one_slot.h"
#include "sim/frame/frame.h"
#include "sim/scene/scene.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <atomic>
#include <optional>
#include <string>
#include <thread>

namespace sandglass::desktop {

class SceneChecker : public QObject {
  Q_OBJECT
public:
  SceneChecker();
  ~SceneChecker() override;

  /// `file`: for messages, and for where files that the scene names lie.
  void check(const QString& text, const QString& file, bool preview);
  bool isIdle() const { return done_ == asked_ && taken_ == asked_; } ///< all that was asked has been taken

  struct Outcome {
    QString text;
    std::optional<Scene> scene; ///< when it is sound
    QString resolved;           ///< the same in SI units, complete
    FramePtr preview;           ///< null when the scene is not sound or cannot be filled
    QStringList faults;         ///< a sentence each
    std::uint64_t number = 0;   ///< of the order
  };
  std::optional<Outcome> take();

Q_SIGNALS: // from the checker's thread
  void ready();

private:
  struct Order {
    QString text, file;
    bool preview = true;
    std::uint64_t number = 0;
  };
  void work();

  std::atomic<std::uint64_t> asked_{0}, done_{0}, taken_{0};
  OneSlot<Order> in_;
  OneSlot<Outcome> out_;
  std::thread thread_;
};

/// Scenes with more grains than this show walls alone before they run.
inline constexpr std::int64_t mostPreviewGrains = 30000;

} // namespace sandglass::desktop
