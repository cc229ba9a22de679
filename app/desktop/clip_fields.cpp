#include "app/desktop/clip_fields.h"

#include <QHBoxLayout>
#include <QSignalBlocker>

namespace sandglass::desktop {

namespace {

Vec3 vec(const NumbersEdit* edit) {
  const auto& v = edit->values();
  return {v[0], v[1], v[2]};
}

std::vector<double> list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

QHBoxLayout* pairOf(QCheckBox* first, QCheckBox* second) {
  auto* row = new QHBoxLayout;
  row->addWidget(first, 1);
  row->addWidget(second);
  return row;
}

} // namespace

ClipFields::ClipFields(QFormLayout* form) : QObject(form->parentWidget()) {
  addBox(form);
  addCylinder(form);
  for (auto* edit : {lower_, upper_, point_, axis_, radius_})
    connect(edit, &NumbersEdit::edited, this, &ClipFields::check);
  for (auto* box : {box_, boxOutside_, cylinder_, cylinderOutside_})
    connect(box, &QCheckBox::toggled, this, &ClipFields::check);
  setSpace(Vec3::Zero(), Vec3::Ones());
  enable();
}

void ClipFields::addBox(QFormLayout* form) {
  box_ = new QCheckBox("by a box");
  box_->setObjectName("clipBox");
  boxOutside_ = new QCheckBox("keep outside");
  boxOutside_->setObjectName("clipBoxOutside");
  form->addRow(pairOf(box_, boxOutside_));
  lower_ = new NumbersEdit("clipBoxLower", 3, "m", "Lower corner of the box: x, y, z");
  upper_ = new NumbersEdit("clipBoxUpper", 3, "m", "Upper corner of the box: x, y, z");
  form->addRow("Lower", lower_);
  form->addRow("Upper", upper_);
}

void ClipFields::addCylinder(QFormLayout* form) {
  cylinder_ = new QCheckBox("by a cylinder");
  cylinder_->setObjectName("clipCylinder");
  cylinderOutside_ = new QCheckBox("keep outside");
  cylinderOutside_->setObjectName("clipCylinderOutside");
  form->addRow(pairOf(cylinder_, cylinderOutside_));
  point_ = new NumbersEdit("clipCylinderPoint", 3, "m", "A point on the axis of the cylinder: x, y, z");
  axis_ = new NumbersEdit("clipCylinderAxis", 3, "", "Direction of the axis: x, y, z");
  radius_ = new NumbersEdit("clipCylinderRadius", 1, "m", "Radius of the cylinder");
  form->addRow("Point", point_);
  form->addRow("Axis", axis_);
  form->addRow("Radius", radius_);
}

void ClipFields::enable() {
  for (QWidget* w :
       {static_cast<QWidget*>(boxOutside_), static_cast<QWidget*>(lower_), static_cast<QWidget*>(upper_)})
    w->setEnabled(box_->isChecked());
  for (QWidget* w : {static_cast<QWidget*>(cylinderOutside_), static_cast<QWidget*>(point_),
                     static_cast<QWidget*>(axis_), static_cast<QWidget*>(radius_)})
    w->setEnabled(cylinder_->isChecked());
}

/// The rules of view files (view_file.cpp), each at its field.
void ClipFields::check() {
  boxTouched_ = boxTouched_ || box_->isChecked();
  cylinderTouched_ = cylinderTouched_ || cylinder_->isChecked();
  enable();
  upper_->breakRule((vec(upper_).array() > vec(lower_).array()).all()
                        ? ""
                        : "each coordinate must be above that of the lower corner");
  axis_->breakRule(vec(axis_).norm() > 0 ? "" : "the axis needs a direction");
  radius_->breakRule(radius_->values()[0] > 0 ? "" : "the radius must be above 0");
  for (const auto* edit : {lower_, upper_, point_, axis_, radius_})
    if (!edit->isSound()) return;
  soundBox_ = {vec(lower_), vec(upper_), !boxOutside_->isChecked()};
  soundCylinder_ = {vec(point_), vec(axis_), radius_->values()[0], !cylinderOutside_->isChecked()};
  Q_EMIT changed();
}

void ClipFields::setSpace(const Vec3& lower, const Vec3& upper) {
  const Vec3 middle = (lower + upper) / 2, quarter = (upper - lower) / 4;
  if (!boxTouched_) {
    soundBox_.lower = middle - quarter;
    soundBox_.upper = middle + quarter;
  }
  if (!cylinderTouched_) {
    soundCylinder_.point = middle;
    soundCylinder_.radius = quarter.head<2>().minCoeff();
  }
  if (boxTouched_ && cylinderTouched_) return;
  lower_->setValues(list(soundBox_.lower));
  upper_->setValues(list(soundBox_.upper));
  point_->setValues(list(soundCylinder_.point));
  axis_->setValues(list(soundCylinder_.axis));
  radius_->setValues({soundCylinder_.radius});
}

void ClipFields::setView(const vis::View& view) {
  const QSignalBlocker a(box_), b(boxOutside_), c(cylinder_), d(cylinderOutside_);
  box_->setChecked(!view.clipBoxes.empty());
  cylinder_->setChecked(!view.clipCylinders.empty());
  if (box_->isChecked()) {
    boxTouched_ = true;
    soundBox_ = view.clipBoxes.front();
    boxOutside_->setChecked(!soundBox_.inside);
    lower_->setValues(list(soundBox_.lower));
    upper_->setValues(list(soundBox_.upper));
  }
  if (cylinder_->isChecked()) {
    cylinderTouched_ = true;
    soundCylinder_ = view.clipCylinders.front();
    cylinderOutside_->setChecked(!soundCylinder_.inside);
    point_->setValues(list(soundCylinder_.point));
    axis_->setValues(list(soundCylinder_.axis));
    radius_->setValues({soundCylinder_.radius});
  }
  enable();
}

void ClipFields::apply(vis::View& view) const {
  const auto put = [](auto& all, bool on, const auto& first) {
    if (!on) return all.clear();
    if (all.empty()) all.emplace_back();
    all.front() = first;
  };
  put(view.clipBoxes, box_->isChecked(), soundBox_);
  put(view.clipCylinders, cylinder_->isChecked(), soundCylinder_);
}

} // namespace sandglass::desktop
