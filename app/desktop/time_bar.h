#pragma once
// Below the picture: which moment is shown (saved frames, the live one) and how far the run is.

#include "sim/run/run.h"

#include <QLabel>
#include <QProgressBar>
#include <QSlider>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include <optional>

namespace sandglass::desktop {

class TimeBar : public QWidget {
  Q_OBJECT
public:
  explicit TimeBar(QWidget* parent = nullptr);

  void setFrames(std::size_t saved, bool running);
  /// Index of the saved frame to show; nothing: the live one.
  std::optional<std::size_t> chosen() const;
  void choose(std::optional<std::size_t> index); ///< emits chosenChanged() when that is another one
  void stepBy(int frames);
  void play(bool on); ///< saved frames one after the other, round and round
  void setTime(const QString& text) { time_->setText(text); }
  void setProgress(const std::optional<Progress>& progress, const QString& state);

Q_SIGNALS:
  void chosenChanged();

private:
  QSlider* slider_;
  QToolButton* live_;
  QLabel *time_, *state_;
  QProgressBar* bar_;
  QTimer play_;
  bool followsLive_ = true, running_ = false;
};

/// "3 min 20 s".
QString durationText(double seconds);

} // namespace sandglass::desktop
