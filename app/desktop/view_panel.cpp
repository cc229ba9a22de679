#include "app/desktop/view_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QScrollBar>
#include <QSignalBlocker>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr int clipSteps = 400; ///< places of the clip plane across the domain
const char* const oneColour = "one colour";

QDoubleSpinBox* limitBox(QWidget* parent, const char* name, double value) {
  auto* box = new QDoubleSpinBox(parent);
  box->setObjectName(name);
  box->setDecimals(6);
  box->setRange(-1e12, 1e12);
  box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  box->setValue(value);
  box->setKeyboardTracking(false);
  box->setMinimumWidth(80);
  return box;
}

QLabel* heading(const QString& text) {
  auto* label = new QLabel(text);
  label->setProperty("heading", true);
  return label;
}

} // namespace

ViewPanel::ViewPanel(QWidget* parent) : QScrollArea(parent) {
  setObjectName("view");
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* page = new QWidget;
  page->setAutoFillBackground(true);
  page->setBackgroundRole(QPalette::Base);
  setWidget(page);
  auto* form = new QFormLayout(page);
  form->setContentsMargins(12, 10, 12, 10);
  form->setVerticalSpacing(7);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  addColours(form);
  addClip(form);
  form->addRow(heading("Show"));
  shown_ = new ShownFields(form);
  connect(shown_, &ShownFields::changed, this, &ViewPanel::changed);
  addForces(form);
  form->addRow(heading("Slice through a field"));
  slice_ = new SliceFields(form);
  connect(slice_, &SliceFields::changed, this, &ViewPanel::changed);
  setView({});
}

QSize ViewPanel::minimumSizeHint() const {
  return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(),
          QScrollArea::minimumSizeHint().height()};
}

void ViewPanel::addColours(QFormLayout* form) {
  form->addRow(heading("Colour"));
  quantity_ = new QComboBox(this);
  quantity_->setObjectName("quantity");
  quantity_->addItem(oneColour);
  form->addRow("Quantity", quantity_);
  map_ = new QComboBox(this);
  map_->setObjectName("map");
  for (const auto& name : vis::colourMaps())
    map_->addItem(QString::fromStdString(name));
  form->addRow("Colours", map_);
  range_ = new QComboBox(this);
  range_->setObjectName("range");
  range_->addItems({"of this frame", "of the whole run", "fixed"}); // in the order of ColourRange
  form->addRow("Range", range_);
  auto* limits = new QHBoxLayout;
  low_ = limitBox(this, "low", 0);
  high_ = limitBox(this, "high", 1);
  limits->addWidget(low_);
  limits->addWidget(high_);
  form->addRow("Limits", limits);
  auto* steps = new QHBoxLayout;
  bands_ = new QSpinBox(this);
  bands_->setObjectName("bands");
  bands_->setRange(0, 64);
  bands_->setSpecialValueText("smooth");
  bands_->setToolTip("So many steps instead of a smooth map of colours");
  reversed_ = new QCheckBox("reversed", this);
  reversed_->setObjectName("reversed");
  steps->addWidget(bands_, 1);
  steps->addWidget(reversed_);
  form->addRow("Steps", steps);
  connect(bands_, QOverload<int>::of(&QSpinBox::valueChanged), this, &ViewPanel::changed);
  connect(reversed_, &QCheckBox::toggled, this, &ViewPanel::changed);
  for (auto* box : {quantity_, map_, range_})
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] {
      enable();
      Q_EMIT changed();
    });
  for (auto* box : {low_, high_})
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &ViewPanel::changed);
}

void ViewPanel::addClip(QFormLayout* form) {
  form->addRow(heading("Cut"));
  clips_ = new QCheckBox("cut open", this);
  clips_->setObjectName("clip");
  axis_ = new QComboBox(this);
  axis_->setObjectName("clipAxis");
  axis_->addItems({"across x", "across y", "across z"});
  auto* first = new QHBoxLayout;
  first->addWidget(clips_);
  first->addWidget(axis_, 1);
  form->addRow("Plane", first);
  position_ = new QSlider(Qt::Horizontal, this);
  position_->setObjectName("clipPosition");
  position_->setRange(0, clipSteps);
  position_->setValue(clipSteps / 2);
  flip_ = new QCheckBox("flip", this);
  flip_->setObjectName("clipFlip");
  auto* second = new QHBoxLayout;
  second->addWidget(position_, 1);
  second->addWidget(flip_);
  form->addRow("Place", second);
  for (auto* box : {clips_, flip_})
    connect(box, &QCheckBox::toggled, this, [this] {
      enable();
      Q_EMIT changed();
    });
  connect(axis_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ViewPanel::changed);
  connect(position_, &QSlider::valueChanged, this, &ViewPanel::changed);
  cuts_ = new ClipFields(form);
  connect(cuts_, &ClipFields::changed, this, &ViewPanel::changed);
}

void ViewPanel::addForces(QFormLayout* form) {
  form->addRow(heading("Grains and forces"));
  selection_ = new QLineEdit(this);
  selection_->setObjectName("selection");
  selection_->setPlaceholderText("such as z > 0.05 && speed < 0.1");
  selection_->setToolTip("Grains chosen by an expression over their quantities");
  form->addRow("Grains", selection_);
  selectionUse_ = new QComboBox(this);
  selectionUse_->setObjectName("selectionUse");
  selectionUse_->addItems({"draw only these", "hide these", "others pale"}); // in the order of Selection::Use
  form->addRow("", selectionUse_);
  chains_ = new QCheckBox("force chains", this);
  chains_->setObjectName("forceChains");
  chains_->setToolTip(
      "Contacts as tubes as thick as their force; the scene's [output] needs contacts = true");
  arrows_ = new QComboBox(this);
  arrows_->setObjectName("arrows");
  arrows_->setToolTip("A vector of each grain as an arrow");
  arrows_->addItem("no arrows");
  auto* row = new QHBoxLayout;
  row->addWidget(chains_);
  row->addWidget(arrows_, 1);
  form->addRow(row);
  connect(selection_, &QLineEdit::editingFinished, this, [this] {
    if (selection_->isModified()) Q_EMIT changed();
    selection_->setModified(false);
  });
  for (auto* box : {selectionUse_, arrows_})
    connect(box, QOverload<int>::of(&QComboBox::activated), this, &ViewPanel::changed);
  connect(chains_, &QCheckBox::toggled, this, &ViewPanel::changed);
}

void ViewPanel::enable() {
  const bool coloured = quantity_->currentText() != oneColour;
  const bool fixed = coloured && range_->currentIndex() == static_cast<int>(vis::ColourRange::fixed);
  map_->setEnabled(coloured);
  range_->setEnabled(coloured);
  low_->setEnabled(fixed);
  high_->setEnabled(fixed);
  for (QWidget* w :
       {static_cast<QWidget*>(axis_), static_cast<QWidget*>(position_), static_cast<QWidget*>(flip_)})
    w->setEnabled(clips_->isChecked());
}

void ViewPanel::setFrame(const Frame& frame) {
  lower_ = frame.domain.lower;
  upper_ = frame.domain.upper;
  cuts_->setSpace(lower_, upper_);
  slice_->setFrame(frame);
  QStringList vectors{"no arrows"}, now;
  for (const auto& [name, list] : frame.vectors)
    vectors << QString::fromStdString(name);
  for (int k = 0; k < arrows_->count(); ++k)
    now << arrows_->itemText(k);
  if (vectors != now) {
    const QString chosen = arrows_->currentText();
    arrows_->clear();
    arrows_->addItems(vectors);
    arrows_->setCurrentIndex(std::max(0, arrows_->findText(chosen)));
  }
  auto names = grainScalarNames(frame);
  if (frame.persistentIds)
    for (const char* axis : {"original.x", "original.y", "original.z"})
      names.emplace_back(axis);
  if (names == names_) return;
  names_ = names;
  const QSignalBlocker blocker(quantity_);
  const QString chosen = quantity_->currentText();
  quantity_->clear();
  quantity_->addItem(oneColour);
  for (const auto& name : names)
    quantity_->addItem(QString::fromStdString(name));
  const int index = quantity_->findText(chosen);
  quantity_->setCurrentIndex(std::max(index, 0));
  enable();
}

void ViewPanel::setView(const vis::View& view) {
  const QSignalBlocker a(quantity_), b(map_), c(range_), d(low_), e(high_), f(clips_), g(axis_), h(position_),
      i(flip_), j(bands_), k(reversed_), l(chains_), m(arrows_), n(selectionUse_), o(selection_);
  shown_->setView(view);
  cuts_->setView(view);
  slice_->setView(view);
  const QString quantity =
      view.colouring.quantity.empty() ? oneColour : QString::fromStdString(view.colouring.quantity);
  if (quantity_->findText(quantity) < 0) quantity_->addItem(quantity);
  quantity_->setCurrentText(quantity);
  map_->setCurrentText(QString::fromStdString(view.colouring.map));
  range_->setCurrentIndex(static_cast<int>(view.colouring.range));
  low_->setValue(view.colouring.low);
  high_->setValue(view.colouring.high);
  bands_->setValue(view.colouring.bands);
  reversed_->setChecked(view.colouring.reversed);
  chains_->setChecked(view.forceChains.shown);
  const QString arrows =
      view.arrows.vector.empty() ? "no arrows" : QString::fromStdString(view.arrows.vector);
  if (arrows_->findText(arrows) < 0) arrows_->addItem(arrows);
  arrows_->setCurrentText(arrows);
  selection_->setText(QString::fromStdString(view.selection.expression));
  selectionUse_->setCurrentIndex(static_cast<int>(view.selection.use));
  clips_->setChecked(!view.clips.empty());
  if (!view.clips.empty()) {
    Eigen::Index axis = 0;
    const auto& clip = view.clips.front();
    clip.normal.cwiseAbs().maxCoeff(&axis);
    axis_->setCurrentIndex(static_cast<int>(axis));
    flip_->setChecked(clip.normal[axis] < 0);
    const double size = upper_[axis] - lower_[axis];
    if (size > 0)
      position_->setValue(static_cast<int>(clipSteps * (clip.point[axis] - lower_[axis]) / size + 0.5));
  }
  enable();
}

Vec3 ViewPanel::clipPoint() const {
  return lower_ + (upper_ - lower_) * position_->value() / clipSteps;
}

void ViewPanel::apply(vis::View& view) const {
  const QString quantity = quantity_->currentText();
  view.colouring.quantity = quantity == oneColour ? "" : quantity.toStdString();
  view.colouring.map = map_->currentText().toStdString();
  view.colouring.range = static_cast<vis::ColourRange>(range_->currentIndex());
  if (view.colouring.range == vis::ColourRange::fixed) {
    view.colouring.low = std::min(low_->value(), high_->value());
    view.colouring.high = std::max(low_->value(), high_->value());
    if (!(view.colouring.high > view.colouring.low)) view.colouring.high = view.colouring.low + 1e-6;
  }
  view.colouring.bands = bands_->value();
  view.colouring.reversed = reversed_->isChecked();
  view.forceChains.shown = chains_->isChecked();
  view.arrows.vector = arrows_->currentIndex() > 0 ? arrows_->currentText().toStdString() : "";
  view.selection.expression = selection_->text().trimmed().toStdString();
  view.selection.use = static_cast<vis::Selection::Use>(selectionUse_->currentIndex());
  shown_->apply(view);
  cuts_->apply(view);
  slice_->apply(view);
  if (!clips_->isChecked()) return view.clips.clear();
  if (view.clips.empty()) view.clips.emplace_back(); // further planes are kept as they are
  const double side = flip_->isChecked() ? -1 : 1;
  view.clips.front() = {clipPoint(), side * Vec3::Unit(axis_->currentIndex())};
}

} // namespace sandglass::desktop
