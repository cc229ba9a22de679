#include "app/desktop/shown_fields.h"

#include <QGridLayout>
#include <QSignalBlocker>

#include <algorithm>

namespace sandglass::desktop {

namespace {

constexpr std::array<double, 3> lightGround{1, 1, 1}, darkGround{0.11, 0.12, 0.13};
constexpr int mostCopies = 5; ///< on each side

bool isDark(const std::array<double, 3>& ground) {
  return ground[0] + ground[1] + ground[2] < 1.5;
}

int copiesOf(const vis::View& view) {
  return *std::max_element(view.periodicImages.begin(), view.periodicImages.end());
}

} // namespace

ShownFields::ShownFields(QFormLayout* form) : QObject(form->parentWidget()) {
  auto* parent = form->parentWidget();
  auto* grid = new QGridLayout;
  const auto box = [&](const char* name, const QString& text, bool vis::View::*field, int row, int column) {
    auto* made = new QCheckBox(text, parent);
    made->setObjectName(name);
    grid->addWidget(made, row, column);
    connect(made, &QCheckBox::toggled, this, &ShownFields::changed);
    if (field) boxes_.push_back({made, field});
    return made;
  };
  box("showGrains", "grains", &vis::View::grains, 0, 0);
  box("showWalls", "walls", &vis::View::walls, 0, 1);
  box("showRemovedWalls", "removed walls", &vis::View::removedWalls, 0, 2);
  box("showLegend", "legend", &vis::View::legend, 1, 0);
  box("showAxes", "axes", &vis::View::axes, 1, 1);
  dark_ = box("darkGround", "dark ground", nullptr, 1, 2);
  box("showScale", "scale", &vis::View::scaleBar, 2, 0);
  box("showTime", "time", &vis::View::timeStamp, 2, 1);
  box("showBox", "box", &vis::View::box, 2, 2)->setToolTip("The outline of the domain, where it is periodic");
  form->addRow(grid);
  opacity_ = new QSlider(Qt::Horizontal, parent);
  opacity_->setObjectName("wallOpacity");
  opacity_->setRange(0, 100);
  form->addRow("Wall tint", opacity_);
  grainScale_ = new QDoubleSpinBox(parent);
  grainScale_->setObjectName("grainScale");
  grainScale_->setRange(0.05, 10);
  grainScale_->setSingleStep(0.05);
  grainScale_->setSuffix(" of true size");
  grainScale_->setToolTip("Smaller grains let force chains and arrows be seen");
  form->addRow("Grain size", grainScale_);
  copies_ = new QSpinBox(parent);
  copies_->setObjectName("copies");
  copies_->setRange(0, mostCopies);
  copies_->setSpecialValueText("no copies");
  copies_->setSuffix(" on each side");
  copies_->setToolTip("Copies of everything along the periodic directions");
  form->addRow("Periodic", copies_);
  connect(opacity_, &QSlider::valueChanged, this, &ShownFields::changed);
  connect(grainScale_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &ShownFields::changed);
  connect(copies_, QOverload<int>::of(&QSpinBox::valueChanged), this, &ShownFields::changed);
}

void ShownFields::setView(const vis::View& view) {
  const QSignalBlocker blocker(this);
  for (const auto& [box, field] : boxes_)
    box->setChecked(view.*field);
  dark_->setChecked(isDark(view.background));
  opacity_->setValue(static_cast<int>(100 * view.wallOpacity + 0.5));
  grainScale_->setValue(view.grainScale);
  copies_->setValue(copiesOf(view));
}

void ShownFields::apply(vis::View& view) const {
  for (const auto& [box, field] : boxes_)
    view.*field = box->isChecked();
  // What the fields cannot tell exactly is left as the view has it until they are changed.
  if (dark_->isChecked() != isDark(view.background))
    view.background = dark_->isChecked() ? darkGround : lightGround;
  if (copies_->value() != copiesOf(view)) view.periodicImages.fill(copies_->value());
  view.wallOpacity = opacity_->value() / 100.0;
  view.grainScale = grainScale_->value();
}

} // namespace sandglass::desktop
