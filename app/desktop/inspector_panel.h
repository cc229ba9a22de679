#pragma once
// All about one grain: its values, its contacts, and how one of its values went over the run.

#include "app/desktop/chart_panel.h"
#include "app/desktop/frame_store.h"

#include <QThreadPool>
#include <QTreeWidget>
#include <QWidget>

#include <atomic>
#include <memory>

namespace sandglass::desktop {

class InspectorPanel : public QWidget {
  Q_OBJECT
public:
  explicit InspectorPanel(QWidget* parent = nullptr);
  ~InspectorPanel() override;

  /// Shows the grain in this frame; negative: none. The history is read from `store` in a worker.
  void show(std::int64_t grain, const FramePtr& frame, std::shared_ptr<const FrameStore> store);
  /// Numbers of the grains with these ids (ascending) in this frame: how many, mean, least and most.
  void showMany(const std::vector<std::int64_t>& grains, const FramePtr& frame);
  std::int64_t grain() const { return grain_; }
  FramePtr frame() const { return frame_; }
  ChartPanel* history() const { return history_; }
  bool isSettled() const { return reading_ == 0; }

private:
  void showValues(const Frame& frame);
  void readHistory();

  QTreeWidget* values_;
  ChartPanel* history_;
  std::int64_t grain_ = -1;
  FramePtr frame_;
  std::shared_ptr<const FrameStore> store_;
  std::string historyOf_; ///< grain, store, frames and quantity of the curve shown or being read
  std::shared_ptr<std::atomic<bool>> stale_;
  int reading_ = 0;
  QThreadPool pool_;
};

} // namespace sandglass::desktop
