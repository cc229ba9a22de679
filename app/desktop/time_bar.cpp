#include "app/desktop/time_bar.h"

#include <QGridLayout>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace sandglass::desktop {

namespace {

constexpr int playInterval = 125; ///< [ms] between frames; those that cannot be drawn in time are passed over

} // namespace

QString durationText(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return QString("%1 s").arg(whole);
  if (whole < 3600) return QString("%1 min %2 s").arg(whole / 60).arg(whole % 60);
  return QString("%1 h %2 min").arg(whole / 3600).arg(whole % 3600 / 60);
}

TimeBar::TimeBar(QWidget* parent) : QWidget(parent) {
  setObjectName("timeBar");
  setAttribute(Qt::WA_StyledBackground);
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setObjectName("time");
  slider_->setToolTip("The saved frames of the run");
  live_ = new QToolButton(this);
  live_->setObjectName("live");
  live_->setText("Live");
  live_->setCheckable(true);
  live_->setToolTip("Follow the running simulation");
  time_ = new QLabel(this);
  time_->setMinimumWidth(190);
  bar_ = new QProgressBar(this);
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setFixedHeight(6);
  state_ = new QLabel(this);
  state_->setObjectName("state");

  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(12, 8, 12, 8);
  grid->setHorizontalSpacing(12);
  grid->setVerticalSpacing(6);
  grid->addWidget(time_, 0, 0);
  grid->addWidget(slider_, 0, 1);
  grid->addWidget(live_, 0, 2);
  grid->addWidget(state_, 1, 0, 1, 1);
  grid->addWidget(bar_, 1, 1, 1, 2);
  grid->setColumnStretch(1, 1);

  connect(slider_, &QSlider::valueChanged, this, [this] {
    followsLive_ = false;
    live_->setChecked(false);
    Q_EMIT chosenChanged();
  });
  connect(live_, &QToolButton::clicked, this, [this] { choose(std::nullopt); });
  play_.setInterval(playInterval);
  connect(&play_, &QTimer::timeout, this,
          [this] { slider_->setValue(slider_->value() < slider_->maximum() ? slider_->value() + 1 : 0); });
  setFrames(0, false);
  setProgress(std::nullopt, "");
}

void TimeBar::play(bool on) {
  if (on)
    play_.start();
  else
    play_.stop();
}

void TimeBar::setFrames(std::size_t saved, bool running) {
  const QSignalBlocker blocker(slider_);
  const bool atEnd = followsLive_ || (!running && running_ && slider_->value() == slider_->maximum());
  running_ = running;
  slider_->setRange(0, static_cast<int>(std::max<std::size_t>(saved, 1)) - 1);
  slider_->setEnabled(saved > 1);
  slider_->setPageStep(std::max(1, static_cast<int>(saved) / 20));
  live_->setEnabled(running);
  if (atEnd) slider_->setValue(slider_->maximum());
  live_->setChecked(running && followsLive_);
}

std::optional<std::size_t> TimeBar::chosen() const {
  if (running_ && followsLive_) return std::nullopt;
  return static_cast<std::size_t>(slider_->value());
}

void TimeBar::choose(std::optional<std::size_t> index) {
  const auto before = chosen();
  const QSignalBlocker blocker(slider_);
  followsLive_ = !index;
  slider_->setValue(index ? static_cast<int>(*index) : slider_->maximum());
  live_->setChecked(running_ && followsLive_);
  if (chosen() != before) Q_EMIT chosenChanged();
}

void TimeBar::stepBy(int frames) {
  slider_->setValue(slider_->value() + frames);
}

void TimeBar::setProgress(const std::optional<Progress>& progress, const QString& state) {
  bar_->setValue(progress ? static_cast<int>(1000 * progress->fraction) : 0);
  state_->setText(state);
}

} // namespace sandglass::desktop
