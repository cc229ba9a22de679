#include "app/desktop/slice_fields.h"

#include "vis/coarse_fields.h"

#include <QHBoxLayout>
#include <QSignalBlocker>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int places = 400; ///< of the plane across the domain

QSlider* slider(const char* name, int most, int value) {
  auto* made = new QSlider(Qt::Horizontal);
  made->setObjectName(name);
  made->setAccessibleName(name);
  made->setRange(0, most);
  made->setValue(value);
  return made;
}

/// Every array of the frame's first field, or what would be coarse-grained.
QStringList quantitiesOf(const Frame& frame) {
  QStringList names;
  if (frame.fields.empty()) {
    for (const auto& name : vis::fieldQuantities())
      names << QString::fromStdString(name);
    return names;
  }
  for (const auto& [name, values] : frame.fields.front().scalars)
    names << QString::fromStdString(name);
  for (const auto& [name, values] : frame.fields.front().vectors)
    for (const char* part : {"", ".x", ".y", ".z"})
      names << QString::fromStdString(name) + part;
  return names;
}

} // namespace

SliceFields::SliceFields(QFormLayout* form) : QObject(form->parentWidget()) {
  shown_ = new QCheckBox("slice");
  shown_->setObjectName("slice");
  shown_->setToolTip("A plane through averages over the grains, coarse-grained where the frame has none");
  axis_ = new QComboBox;
  axis_->setObjectName("sliceAxis");
  axis_->addItems({"across x", "across y", "across z"});
  axis_->setCurrentIndex(1);
  auto* first = new QHBoxLayout;
  first->addWidget(shown_);
  first->addWidget(axis_, 1);
  form->addRow("Plane", first);
  quantity_ = new QComboBox;
  quantity_->setObjectName("sliceQuantity");
  for (const auto& name : vis::fieldQuantities())
    quantity_->addItem(QString::fromStdString(name));
  form->addRow("Field", quantity_);
  map_ = new QComboBox;
  map_->setObjectName("sliceMap");
  for (const auto& name : vis::colourMaps())
    map_->addItem(QString::fromStdString(name));
  form->addRow("Colours", map_);
  place_ = slider("slicePlace", places, places / 2);
  form->addRow("Place", place_);
  opacity_ = slider("sliceOpacity", 100, 100);
  streamlines_ = new QCheckBox("streamlines");
  streamlines_->setObjectName("streamlines");
  auto* last = new QHBoxLayout;
  last->addWidget(opacity_, 1);
  last->addWidget(streamlines_);
  form->addRow("Tint", last);
  range_ = new NumbersEdit("sliceRange", 2, "", "low, high; empty: of this frame", true);
  form->addRow("Range", range_);

  for (auto* box : {shown_, streamlines_})
    connect(box, &QCheckBox::toggled, this, &SliceFields::check);
  for (auto* box : {axis_, quantity_, map_})
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &SliceFields::check);
  for (auto* at : {place_, opacity_})
    connect(at, &QSlider::valueChanged, this, &SliceFields::check);
  connect(range_, &NumbersEdit::edited, this, &SliceFields::check);
  enable();
}

void SliceFields::enable() {
  for (QWidget* w :
       {static_cast<QWidget*>(axis_), static_cast<QWidget*>(quantity_), static_cast<QWidget*>(map_),
        static_cast<QWidget*>(place_), static_cast<QWidget*>(opacity_), static_cast<QWidget*>(streamlines_),
        static_cast<QWidget*>(range_)})
    w->setEnabled(shown_->isChecked());
}

void SliceFields::check() {
  enable();
  const auto& limits = range_->values();
  range_->breakRule(limits.empty() || limits[1] > limits[0] ? "" : "high must be above low");
  if (range_->isSound()) Q_EMIT changed();
}

void SliceFields::setFrame(const Frame& frame) {
  lower_ = frame.domain.lower;
  upper_ = frame.domain.upper;
  const QStringList there = quantitiesOf(frame);
  QStringList now;
  for (int k = 0; k < quantity_->count(); ++k)
    now << quantity_->itemText(k);
  if (there == now) return;
  const QSignalBlocker blocker(quantity_);
  const QString chosen = quantity_->currentText();
  quantity_->clear();
  quantity_->addItems(there);
  quantity_->setCurrentIndex(std::max(0, quantity_->findText(chosen)));
}

void SliceFields::setView(const vis::View& view) {
  const QSignalBlocker a(shown_), b(axis_), c(quantity_), d(map_), e(place_), f(opacity_), g(streamlines_);
  const vis::FieldSlice& slice = view.slice;
  shown_->setChecked(slice.shown);
  if (!slice.quantity.empty()) {
    const QString quantity = QString::fromStdString(slice.quantity);
    if (quantity_->findText(quantity) < 0) quantity_->addItem(quantity);
    quantity_->setCurrentText(quantity);
  }
  map_->setCurrentText(QString::fromStdString(slice.map));
  opacity_->setValue(static_cast<int>(100 * slice.opacity + 0.5));
  streamlines_->setChecked(!slice.streamlines.empty());
  if (slice.range == vis::ColourRange::frame)
    range_->setValues({});
  else
    range_->setValues({slice.low, slice.high});
  if (slice.shown) {
    Eigen::Index axis = 0;
    slice.normal.cwiseAbs().maxCoeff(&axis);
    axis_->setCurrentIndex(static_cast<int>(axis));
    const double size = upper_[axis] - lower_[axis];
    if (size > 0)
      place_->setValue(static_cast<int>(places * (slice.point[axis] - lower_[axis]) / size + 0.5));
  }
  enable();
}

void SliceFields::apply(vis::View& view) const {
  vis::FieldSlice& slice = view.slice;
  slice.shown = shown_->isChecked();
  if (!slice.shown) return;
  slice.quantity = quantity_->currentText().toStdString();
  slice.map = map_->currentText().toStdString();
  slice.point = lower_ + (upper_ - lower_) * place_->value() / places;
  slice.normal = Vec3::Unit(axis_->currentIndex());
  slice.opacity = opacity_->value() / 100.0;
  slice.streamlines = streamlines_->isChecked() ? "velocity" : "";
  const auto& limits = range_->values();
  slice.range = limits.empty() ? vis::ColourRange::frame : vis::ColourRange::fixed;
  if (!limits.empty()) slice.low = limits[0], slice.high = limits[1];
}

} // namespace sandglass::desktop
