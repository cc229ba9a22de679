#include "vis/overlay.h"

#include "vis/text_style.h"
#include "vis/ticks.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace sandglass::vis {

namespace {

// Lengths in pixels of a picture 720 high; everything scales with the picture.
constexpr float margin = 26, titleSize = 19, textSize = 15, barWidth = 18, legendSpace = 128;
constexpr float axesArm = 26, axesSpace = 88, topSpace = 58;

enum class Side { left, centre, right };

float scaleOf(const OverlayContent& c) {
  // Small pictures get relatively larger writing, or nobody could read it.
  const auto finer = static_cast<float>(c.supersampling);
  return finer *
         std::pow(std::min(static_cast<float>(c.width) / 1280, static_cast<float>(c.height) / 720) / finer,
                  0.8F);
}

void write(vtkContext2D* painter, const OverlayContent& c, float x, float y, const std::string& text,
           float size, Side side, bool bold = false, bool backed = false) {
  constexpr double strength = 0.85;
  const auto ink = inkOn(c.background, strength);
  vtkTextProperty* style = painter->GetTextProp();
  setFont(style, static_cast<int>(std::lround(size * scaleOf(c))), bold);
  style->SetColor(ink[0], ink[1], ink[2]);
  style->SetOpacity(1);
  style->SetOrientation(0);
  style->SetVerticalJustificationToCentered();
  if (side == Side::left)
    style->SetJustificationToLeft();
  else if (side == Side::right)
    style->SetJustificationToRight();
  else
    style->SetJustificationToCentered();
  if (backed) { // a pale ground under writing that lines of the scene may cross
    float bounds[4]{};
    painter->ComputeStringBounds(text.c_str(), bounds);
    const float wide = bounds[2], high = 1.5F * size * scaleOf(c), air = 5 * scaleOf(c);
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColorF(c.background[0], c.background[1], c.background[2], 0.8);
    painter->DrawRect(side == Side::left ? x - air : x - wide - air, y - high / 2, wide + 2 * air, high);
  }
  painter->DrawString(std::round(x), std::round(y), text.c_str());
}

float textWidth(vtkContext2D* painter, const OverlayContent& c, const std::string& text, float size) {
  setFont(painter->GetTextProp(), static_cast<int>(std::lround(size * scaleOf(c))));
  float bounds[4]{};
  painter->ComputeStringBounds(text.c_str(), bounds);
  return bounds[2];
}

void setPen(vtkContext2D* painter, const std::array<double, 3>& colour, float width) {
  painter->GetPen()->SetColorF(colour[0], colour[1], colour[2]);
  painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
  painter->GetPen()->SetWidth(width);
}

void fill(vtkContext2D* painter, const std::array<double, 3>& colour, float x, float y, float w, float h) {
  painter->GetPen()->SetLineType(vtkPen::NO_PEN);
  painter->GetBrush()->SetColorF(colour[0], colour[1], colour[2], 1);
  painter->DrawRect(x, y, w, h);
}

std::array<double, 3> toUnit(const Rgb& c) {
  return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0};
}

} // namespace

vtkStandardNewMacro(Overlay);

Frameable freeArea(const View& view, bool titled) {
  OverlayContent c;
  c.width = view.width;
  c.height = view.height;
  const float s = scaleOf(c), w = static_cast<float>(c.width), h = static_cast<float>(c.height);
  const bool legend = view.legend && ((view.grains && !view.colouring.quantity.empty()) ||
                                      view.forceChains.shown || view.slice.shown);
  Frameable area;
  area.left = margin * s / w;
  area.right = 1 - (legend ? legendSpace : margin) * s / w;
  area.top = (titled || view.timeStamp ? topSpace : margin) * s / h;
  area.bottom = 1 - (view.axes || view.scaleBar ? axesSpace : margin) * s / h;
  return area;
}

float Overlay::scale() const {
  return scaleOf(content);
}

bool Overlay::Paint(vtkContext2D* painter) {
  const float s = scale(), w = static_cast<float>(content.width), h = static_cast<float>(content.height);
  const float top = h - (margin + titleSize / 2) * s;
  if (!content.title.empty())
    write(painter, content, margin * s, top, content.title, titleSize, Side::left, true, content.backed);
  if (!content.time.empty())
    write(painter, content, w - margin * s, top, content.time, textSize + 1, Side::right, false,
          content.backed);
  // One legend stands in the middle; several share what title and scale bar leave.
  const bool several = content.legends.size() > 1;
  const float ceiling = several ? h - topSpace * s : h, ground = several ? axesSpace * s : 0;
  const float space =
      (ceiling - ground) / static_cast<float>(std::max<std::size_t>(content.legends.size(), 1));
  for (std::size_t k = 0; k < content.legends.size(); ++k) {
    const float middle = ceiling - (static_cast<float>(k) + 0.5F) * space;
    if (content.legends[k].entries.empty())
      paintLegend(painter, content.legends[k], middle, space);
    else
      paintEntries(painter, content.legends[k], middle);
  }
  if (content.axes) paintAxes(painter, *content.axes);
  if (content.metresPerPixel > 0) paintScaleBar(painter);
  return true;
}

void Overlay::paintLegend(vtkContext2D* painter, const Legend& legend, float middle, float space) const {
  const float s = scale(), w = static_cast<float>(content.width);
  const float right = w - margin * s, left = std::round(w - (legendSpace - margin) * s);
  const float height = std::round(0.5F * space), bottom = std::round(middle - 0.5F * height),
              wide = std::round(barWidth * s);
  const int rows = static_cast<int>(height);
  for (int row = 0; row < rows; ++row)
    fill(painter, toUnit(legend.map.at((row + 0.5) / rows)), left, bottom + static_cast<float>(row), wide, 1);

  const Ticks ticks = niceTicks(legend.low, legend.high, space < 300 * s ? 4 : 6);
  const bool empty = !(legend.high > legend.low);
  for (std::size_t k = 0; k < ticks.values.size(); ++k) {
    const double share = empty ? 0.5 : (ticks.values[k] - legend.low) / (legend.high - legend.low);
    const float y = std::round(bottom + static_cast<float>(share) * (height - 1));
    fill(painter, inkOn(content.background, 0.6), left + wide, y, std::round(5 * s),
         std::max(1.0F, std::round(s)));
    write(painter, content, left + wide + 9 * s, y, ticks.labels[k], textSize, Side::left);
  }
  const std::string title = axisTitle(legend.name, legend.unit, ticks.exponent);
  const float y = bottom + height + 22 * s;
  if (left + textWidth(painter, content, title, textSize) < right)
    write(painter, content, left, y, title, textSize, Side::left);
  else
    write(painter, content, right, y, title, textSize, Side::right);
}

void Overlay::paintEntries(vtkContext2D* painter, const Legend& legend, float middle) const {
  const float s = scale(), w = static_cast<float>(content.width);
  const float left = std::round(w - (legendSpace - margin) * s), line = 24 * s, side = std::round(14 * s);
  float y = middle + 0.5F * line * static_cast<float>(legend.entries.size());
  write(painter, content, left, y + line, legend.name, textSize, Side::left);
  for (std::size_t k = 0; k < legend.entries.size(); ++k, y -= line) {
    fill(painter, toUnit(legend.map.ofIndex(legend.firstEntry + static_cast<long>(k))), left,
         std::round(y - side / 2), side, side);
    write(painter, content, left + side + 8 * s, y, legend.entries[k], textSize, Side::left);
  }
}

void Overlay::paintAxes(vtkContext2D* painter, const CameraAxes& axes) const {
  const float s = scale(), arm = axesArm * s, x0 = (margin + axesArm + 8) * s, y0 = (margin + 18) * s;
  static constexpr const char* names[] = {"x", "y", "z"};
  struct Arrow {
    int axis;
    double right, up, towards;
  };
  std::array<Arrow, 3> arrows{};
  for (int k = 0; k < 3; ++k)
    arrows[k] = {k, axes.right[k], axes.up[k], -axes.forward[k]};
  std::sort(arrows.begin(), arrows.end(),
            [](const Arrow& a, const Arrow& b) { return a.towards < b.towards; });
  for (const Arrow& a : arrows) {
    const double length = std::hypot(a.right, a.up);
    if (length < 0.1) continue; // points at the eye or away from it
    const auto dx = static_cast<float>(a.right / length), dy = static_cast<float>(a.up / length);
    const float x = x0 + arm * static_cast<float>(a.right), y = y0 + arm * static_cast<float>(a.up);
    const auto ink = inkOn(content.background, a.towards < -0.3 ? 0.45 : 0.75);
    setPen(painter, ink, 1.6F * s);
    painter->DrawLine(x0, y0, x, y);
    painter->GetBrush()->SetColorF(ink[0], ink[1], ink[2], 1);
    const float tip = 7 * s, half = 3 * s;
    float px[] = {x + tip * dx, x - half * dy, x + half * dy},
          py[] = {y + tip * dy, y + half * dx, y - half * dx};
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->DrawPolygon(px, py, 3);
    // Below ten pixels a z loses its slant.
    const float size = std::max(textSize - 1, 10 * static_cast<float>(content.supersampling) / s);
    write(painter, content, x + 15 * s * dx, y + 15 * s * dy, names[a.axis], size, Side::centre);
  }
}

void Overlay::paintScaleBar(vtkContext2D* painter) const {
  const float s = scale(), w = static_cast<float>(content.width);
  const double length = roundBelow(0.16 * content.width * content.metresPerPixel);
  const float pixels = std::round(static_cast<float>(length / content.metresPerPixel));
  const float right = std::round(w - margin * s), left = right - pixels, y = std::round(margin * s);
  const float thick = std::max(1.0F, std::round(2.5F * s)), cap = std::round(9 * s);
  const auto ink = inkOn(content.background, 0.8);
  fill(painter, ink, left, y, pixels, thick);
  for (const float x : {left, right - thick})
    fill(painter, ink, x, y + thick / 2 - cap / 2, thick, cap);
  write(painter, content, 0.5F * (left + right), y + 17 * s, lengthText(length), textSize, Side::centre);
}

} // namespace sandglass::vis
