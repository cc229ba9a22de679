#include "app/desktop/inspector_panel.h"

#include "app/desktop/background.h"
#include "sim/base/error.h"

#include <QHeaderView>
#include <QSplitter>
#include <QVBoxLayout>

#include <fmt/format.h>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr std::size_t mostFrames = 200; ///< of a history; more would only cost reading
constexpr int nice = 5;

QString number(double value) {
  return QString::number(value, 'g', 6);
}

QString vector(const Vec3& v) {
  return QString("(%1, %2, %3)").arg(v.x(), 0, 'g', 5).arg(v.y(), 0, 'g', 5).arg(v.z(), 0, 'g', 5);
}

QString withUnit(const QString& value, const std::string& quantity) {
  const QString unit = QString::fromStdString(unitOf(quantity));
  return unit.isEmpty() ? value : value + " " + unit;
}

/// The grain's place in the frame; its size when it is not there.
std::size_t placeOf(const Frame& frame, std::int64_t grain) {
  return static_cast<std::size_t>(std::find(frame.id.begin(), frame.id.end(), grain) - frame.id.begin());
}

analysis::Curve historyOf(const FrameStore& store, std::int64_t grain, const std::string& quantity,
                          const std::atomic<bool>& stale) {
  analysis::Curve curve;
  curve.name = "history";
  curve.x = {"time", "s"};
  curve.y = {quantity, unitOf(quantity)};
  analysis::Series series;
  const std::size_t size = store.size(), stride = 1 + size / mostFrames;
  for (std::size_t k = 0; k < size && !stale; k += stride) {
    const FramePtr frame = store.load(k);
    const std::size_t at = placeOf(*frame, grain);
    if (at >= frame->size()) continue; // not there yet, or gone
    series.x.push_back(frame->time);
    series.y.push_back(grainScalar(*frame, quantity).at(at));
  }
  if (series.x.size() < 2) throw InputError(fmt::format("grain {} is in fewer than two saved frames", grain));
  curve.definition = fmt::format("{} of grain {}", quantity, grain);
  curve.series.push_back(std::move(series));
  return curve;
}

} // namespace

InspectorPanel::InspectorPanel(QWidget* parent) : QWidget(parent) {
  setObjectName("inspector");
  pool_.setMaxThreadCount(1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* split = new QSplitter(Qt::Vertical, this);
  values_ = new QTreeWidget(split);
  values_->setObjectName("grainValues");
  values_->setHeaderLabels({"Quantity", "Value"});
  values_->setRootIsDecorated(true);
  values_->setAlternatingRowColors(true);
  values_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  history_ = new ChartPanel(
      "history", "Click a grain in the picture: its values, contacts and history appear here.", split);
  history_->setMinimumHeight(120);
  split->setStretchFactor(0, 2);
  split->setStretchFactor(1, 3);
  split->setSizes({100, 160});
  column->addWidget(split);
  connect(history_, &ChartPanel::quantityChosen, this, &InspectorPanel::readHistory);
}

InspectorPanel::~InspectorPanel() {
  if (stale_) *stale_ = true;
  pool_.waitForDone();
}

void InspectorPanel::show(std::int64_t grain, const FramePtr& frame,
                          std::shared_ptr<const FrameStore> store) {
  grain_ = grain;
  frame_ = frame;
  store_ = std::move(store);
  if (grain_ < 0 || !frame_) {
    values_->clear();
    historyOf_.clear();
    history_->clear("Click a grain in the picture: its values, contacts and history appear here.");
    return;
  }
  if (!isVisible()) return;
  showValues(*frame_);
  history_->offerQuantities(grainScalarNames(*frame_));
  readHistory();
}

void InspectorPanel::showValues(const Frame& frame) {
  values_->clear();
  const auto add = [&](QTreeWidgetItem* parent, const QString& name, const QString& value) {
    auto* item =
        parent ? new QTreeWidgetItem(parent, {name, value}) : new QTreeWidgetItem(values_, {name, value});
    return item;
  };
  const std::size_t k = placeOf(frame, grain_);
  add(nullptr, "grain", QString::number(grain_));
  add(nullptr, "time", withUnit(number(frame.time), "") + " s");
  if (k >= frame.size()) {
    add(nullptr, "not in this frame", "");
    return;
  }
  add(nullptr, "position", vector(frame.position[k]) + " m");
  for (const auto& [name, list] : frame.scalars) {
    QString value = withUnit(number(list[k]), name);
    if (name == quantity::species && static_cast<std::size_t>(list[k]) < frame.speciesNames.size())
      value = QString::fromStdString(frame.speciesNames[static_cast<std::size_t>(list[k])]);
    add(nullptr, QString::fromStdString(name), value);
  }
  for (const auto& [name, list] : frame.vectors) {
    add(nullptr, QString::fromStdString(name), withUnit(vector(list[k]), name));
    add(nullptr, QString("|%1|").arg(QString::fromStdString(name)), withUnit(number(list[k].norm()), name));
  }
  int count = 0;
  QTreeWidgetItem* contacts = add(nullptr, "contacts", "");
  for (const auto& contact : frame.contacts) {
    if (contact.a != grain_ && contact.b != grain_) continue;
    ++count;
    const bool wall = contact.b < 0;
    const QString with =
        wall ? QString("wall %1").arg(
                   contact.wall >= 0 && static_cast<std::size_t>(contact.wall) < frame.walls.size()
                       ? QString::fromStdString(frame.walls[static_cast<std::size_t>(contact.wall)].name)
                       : QString())
             : QString("grain %1").arg(contact.a == grain_ ? contact.b : contact.a);
    auto* item = add(contacts, with, number(contact.force.norm()) + " N");
    add(item, "overlap", number(contact.overlap) + " m");
    add(item, "force", vector(contact.a == grain_ ? contact.force : Vec3(-contact.force)) + " N");
    add(item, "point", vector(contact.point) + " m");
  }
  contacts->setText(1, frame.contacts.empty() ? "not in the frames: [output] contacts = true"
                                              : QString::number(count));
  contacts->setExpanded(true);
}

void InspectorPanel::showMany(const std::vector<std::int64_t>& grains, const FramePtr& frame) {
  show(-1, nullptr, nullptr);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < frame->size(); ++k)
    if (std::binary_search(grains.begin(), grains.end(), frame->id[k])) places.push_back(k);
  new QTreeWidgetItem(values_, {"grains chosen", QString("%L1").arg(places.size())});
  if (places.empty()) return;
  for (const auto& name : grainScalarNames(*frame)) {
    const auto values = grainScalar(*frame, name);
    double sum = 0, least = values[places[0]], most = least;
    for (const std::size_t k : places) {
      sum += values[k];
      least = std::min(least, values[k]);
      most = std::max(most, values[k]);
    }
    new QTreeWidgetItem(values_, {QString::fromStdString(name),
                                  withUnit(QString("mean %1, from %2 to %3")
                                               .arg(number(sum / static_cast<double>(places.size())))
                                               .arg(number(least))
                                               .arg(number(most)),
                                           name)});
  }
}

void InspectorPanel::readHistory() {
  if (grain_ < 0 || !store_ || store_->size() < 2) return;
  const std::string quantity = history_->quantity().toStdString();
  const std::string key =
      fmt::format("{} {} {} {}", grain_, fmt::ptr(store_.get()), store_->size() / 10, quantity);
  if (key == historyOf_) return;
  historyOf_ = key;
  if (stale_) *stale_ = true;
  stale_ = std::make_shared<std::atomic<bool>>(false);
  ++reading_;
  pool_.start([this, store = store_, grain = grain_, quantity, stale = stale_] {
    lowerPriority(nice);
    std::optional<analysis::Curve> curve;
    QString fault;
    try {
      if (!*stale) curve = historyOf(*store, grain, quantity, *stale);
    } catch (const std::exception& e) {
      fault = QString::fromUtf8(e.what());
    }
    QMetaObject::invokeMethod(this, [this, curve, fault, stale] {
      --reading_;
      if (*stale) return;
      if (curve)
        history_->setCurve(*curve);
      else
        history_->clear(fault);
    });
  });
}

} // namespace sandglass::desktop
