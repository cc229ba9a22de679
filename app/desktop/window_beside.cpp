// Two runs side by side: the run of another tab is the right half of this tab's picture.

#include "app/desktop/inspector_panel.h"
#include "app/desktop/main_window.h"

#include <QSignalBlocker>

#include <algorithm>

namespace sandglass::desktop {

/// The tab to show beside this one: the one looked at before, else the first other one that holds something.
Document* MainWindow::partner() const {
  const auto holds = [this](const Document* d) { return d && d != now_ && d->session->isOpen(); };
  if (holds(before_)) return before_;
  const auto found = std::find_if(documents_.begin(), documents_.end(),
                                  [&](const auto& document) { return holds(document.get()); });
  return found == documents_.end() ? nullptr : found->get();
}

void MainWindow::showBeside(bool on) {
  Document* other = on ? partner() : nullptr;
  if (on && (!other || !session_->isOpen()))
    complain({"Side by side takes two runs: open one in this tab and the other in another tab (Ctrl+T)."});
  setBeside(now_, other);
}

void MainWindow::setBeside(Document* document, Document* other) {
  document->beside = other;
  document->shownBeside.reset();
  if (document->grainBeside) document->grain = -1;
  document->grainBeside = false;
  if (document != now_) return;
  const QSignalBlocker blocker(commands_->action("view.beside"));
  commands_->action("view.beside")->setChecked(other != nullptr);
  if (session_->isOpen()) requestPicture();
}

void MainWindow::forgetBeside(const Document* document) {
  for (const auto& other : documents_)
    if (other->beside == document) setBeside(other.get(), nullptr);
}

/// The live frame beside a live one, else the saved frame of the nearest time.
std::optional<FrameOrder> MainWindow::besideOrder() const {
  const Session& other = *now_->beside->session;
  if (!other.isOpen()) return std::nullopt; // its tab is being opened
  const auto& store = other.current().store;
  FrameOrder order;
  order.run = store;
  order.name = runName(*now_->beside);
  const auto chosen = time_->chosen();
  const bool follows = !chosen || session_->current().store->size() == 0;
  if (follows && other.runs() && other.liveFrame()) {
    order.frame = other.liveFrame();
  } else if (store->size() > 0) {
    const FramePtr live = session_->liveFrame();
    const double time = !follows ? session_->current().store->time(*chosen) : live ? live->time : 0;
    order.index = store->nearest(time);
    order.source = store;
  } else {
    order.frame = other.liveFrame() ? other.liveFrame() : now_->beside->preview;
    if (!order.frame) return std::nullopt;
  }
  return order;
}

void MainWindow::inspect() {
  const bool beside = now_->grainBeside && now_->beside;
  const Document& document = beside ? *now_->beside : *now_;
  inspector_->show(now_->grain, beside ? now_->shownBeside : now_->shown, document.session->current().store);
}

} // namespace sandglass::desktop
