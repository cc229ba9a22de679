#include "vis/clip.h"

#include <vtkActor.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace sandglass::vis {

namespace {

double distanceFromAxis(const ClipCylinder& cylinder, const Vec3& point) {
  return cylinder.axis.normalized().cross(point - cylinder.point).norm();
}

constexpr const char* tag = "//VTK::Clip::Impl";

void set3(vtkUniforms* uniforms, const char* name, const Vec3& v) {
  const float values[] = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  uniforms->SetUniform3f(name, values);
}

void set4(vtkUniforms* uniforms, const std::string& name, const Vec3& v, double w) {
  const float values[] = {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
                          static_cast<float>(w)};
  uniforms->SetUniform4f(name.c_str(), values);
}

double sign(bool inside) {
  return inside ? 1 : -1;
}

} // namespace

bool isClipped(const View& view, const Vec3& point) {
  const auto behind = [&](const ClipPlane& c) { return (point - c.point).dot(c.normal) < 0; };
  const auto outOfBox = [&](const ClipBox& c) {
    const bool inside = (point.array() >= c.lower.array()).all() && (point.array() <= c.upper.array()).all();
    return inside != c.inside;
  };
  const auto outOfCylinder = [&](const ClipCylinder& c) {
    return (distanceFromAxis(c, point) <= c.radius) != c.inside;
  };
  return std::any_of(view.clips.begin(), view.clips.end(), behind) ||
         std::any_of(view.clipBoxes.begin(), view.clipBoxes.end(), outOfBox) ||
         std::any_of(view.clipCylinders.begin(), view.clipCylinders.end(), outOfCylinder);
}

void FragmentClip::setCode(const View& view) {
  counts_ = {view.clips.size(), view.clipBoxes.size(), view.clipCylinders.size()};
  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->ClearFragmentShaderReplacement(tag, true);
  shader->GetFragmentCustomUniforms()->RemoveAllUniforms();
  if (counts_ == std::array<std::size_t, 3>{0, 0, 0}) return;
  std::string code = fmt::format("{}\n  vec3 place = clipEye + clipRight * vertexVC.x + clipUp * vertexVC.y "
                                 "- clipForward * vertexVC.z;\n",
                                 tag);
  for (std::size_t k = 0; k < counts_[0]; ++k)
    code += fmt::format("  if (dot(place, clipPlane{0}.xyz) < clipPlane{0}.w) discard;\n", k);
  for (std::size_t k = 0; k < counts_[1]; ++k)
    code +=
        fmt::format("  vec3 apart{0} = abs(place - clipMiddle{0}.xyz) - clipHalf{0};\n"
                    "  if (clipMiddle{0}.w * max(apart{0}.x, max(apart{0}.y, apart{0}.z)) > 0.0) discard;\n",
                    k);
  for (std::size_t k = 0; k < counts_[2]; ++k)
    code += fmt::format("  if (clipPoint{0}.w * (length(cross(clipAxis{0}.xyz, place - clipPoint{0}.xyz)) - "
                        "clipAxis{0}.w) > 0.0) discard;\n",
                        k);
  shader->AddFragmentShaderReplacement(tag, true, code, false);
}

void FragmentClip::show(const View& view, const Camera& camera) {
  if (counts_ !=
      std::array<std::size_t, 3>{view.clips.size(), view.clipBoxes.size(), view.clipCylinders.size()})
    setCode(view);
  if (counts_ == std::array<std::size_t, 3>{0, 0, 0}) return;
  vtkUniforms* uniforms = actor_->GetShaderProperty()->GetFragmentCustomUniforms();
  const CameraAxes axes = axesOf(camera);
  set3(uniforms, "clipEye", camera.position);
  set3(uniforms, "clipRight", axes.right);
  set3(uniforms, "clipUp", axes.up);
  set3(uniforms, "clipForward", axes.forward);
  for (std::size_t k = 0; k < counts_[0]; ++k)
    set4(uniforms, fmt::format("clipPlane{}", k), view.clips[k].normal,
         view.clips[k].normal.dot(view.clips[k].point));
  for (std::size_t k = 0; k < counts_[1]; ++k) {
    const ClipBox& box = view.clipBoxes[k];
    set4(uniforms, fmt::format("clipMiddle{}", k), (box.lower + box.upper) / 2, sign(box.inside));
    set3(uniforms, fmt::format("clipHalf{}", k).c_str(), (box.upper - box.lower) / 2);
  }
  for (std::size_t k = 0; k < counts_[2]; ++k) {
    const ClipCylinder& cylinder = view.clipCylinders[k];
    set4(uniforms, fmt::format("clipPoint{}", k), cylinder.point, sign(cylinder.inside));
    set4(uniforms, fmt::format("clipAxis{}", k), cylinder.axis.normalized(), cylinder.radius);
  }
}

} // namespace sandglass::vis
