#include "vis/chart_frame.h"

#include "vis/chart_style.h"
#include "vis/text_style.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace sandglass::vis {

namespace {

// Pixels of a chart 540 high.
constexpr float margin = 18, titleSize = 17, keySize = 13, smallSize = 11, markSize = 12;
constexpr float axisSize = 14;
constexpr float titleLine = 34, keyLine = 22, smallLine = 16, axisLine = 24;
constexpr float sampleWidth = 30, pointWidth = 10, sampleGap = 7, entryGap = 24; // of the key

// A panel is for the curve: there the definition has this share of the height, at least a line, and none
// where the panel is flat.
constexpr int panelHeight = 400, flatHeight = 140;
constexpr float panelShare = 0.1F;
constexpr std::size_t mostKeyRows = 3;

// DejaVu Sans is about half of its size wide on average.
constexpr float letterWidth = 0.51F, wideLetterWidth = 0.58F;

void setText(vtkContext2D* painter, const std::array<double, 3>& ground, float size, double strength,
             bool bold = false) {
  vtkTextProperty* style = painter->GetTextProp();
  setFont(style, static_cast<int>(std::lround(size)), bold);
  const auto ink = inkOn(ground, strength);
  style->SetColor(ink[0], ink[1], ink[2]);
  style->SetOpacity(1);
  style->SetOrientation(0);
  style->SetJustificationToLeft();
  style->SetVerticalJustificationToCentered();
}

float widthOf(vtkContext2D* painter, const std::string& text) {
  float bounds[4]{};
  painter->ComputeStringBounds(text.c_str(), bounds);
  return bounds[2];
}

} // namespace

vtkStandardNewMacro(ChartFrame);

SeriesStyle ChartFrame::styleOf(std::size_t series) const {
  SeriesStyle style = vis::styleOf(curve.series[series], series);
  // On dark ground dark colours would be lost: towards white by a third, which leaves them apart.
  if (inkOn(ground, 1)[0] > 0.5)
    for (auto& channel : style.colour)
      channel = static_cast<std::uint8_t>(channel + (255 - channel) / 3);
  return style;
}

bool ChartFrame::hasKey() const {
  return curve.series.size() > 1 || (curve.series.size() == 1 && !curve.series[0].name.empty());
}

std::vector<std::string> ChartFrame::definitionLines() const {
  std::string text = curve.definition;
  if (curve.frames > 1) text += fmt::format("{}{} frames averaged.", text.empty() ? "" : " ", curve.frames);
  const float s = scale;
  const auto longest = static_cast<std::size_t>(
      std::max(20.0F, (static_cast<float>(width) - 2 * margin * s) / (letterWidth * smallSize * s)));
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > longest)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  if (height < flatHeight) return {};
  if (height < panelHeight) {
    const auto most = std::max<std::size_t>(
        1, static_cast<std::size_t>(panelShare * static_cast<float>(height) / (smallLine * s)));
    if (lines.size() > most) {
      lines.resize(most);
      lines.back().resize(std::min(lines.back().size(), longest - 4));
      lines.back() += " ...";
    }
  }
  return lines;
}

std::vector<std::vector<std::size_t>> ChartFrame::keyRows() const {
  std::vector<std::vector<std::size_t>> rows;
  if (!hasKey()) return rows;
  const float s = scale, right = static_cast<float>(width) - margin * s;
  float x = 0;
  for (std::size_t k = 0; k < curve.series.size(); ++k) {
    const auto& series = curve.series[k];
    if (!series.scatter && series.x.empty()) continue;
    const float wide = s * ((series.scatter ? pointWidth : sampleWidth) + sampleGap +
                            wideLetterWidth * keySize * static_cast<float>(series.name.size()));
    if (rows.empty() || (x + wide > right && !rows.back().empty())) {
      if (rows.size() == mostKeyRows) break;
      rows.emplace_back();
      x = margin * s;
    }
    rows.back().push_back(k);
    x += wide + entryGap * s;
  }
  return rows;
}

ChartMargins ChartFrame::margins() const {
  const float s = scale;
  const auto lines = static_cast<float>(definitionLines().size());
  ChartMargins m;
  m.top = s * (margin / 2 + (curve.title.empty() ? 0 : titleLine) +
               static_cast<float>(keyRows().size()) * keyLine);
  m.bottom = s * (axisLine + (lines > 0 ? margin / 2 + lines * smallLine : margin / 4));
  m.left = s * (margin / 2 + axisLine);
  m.right = s * margin;
  return m;
}

bool ChartFrame::Paint(vtkContext2D* painter) {
  const float s = scale, h = static_cast<float>(height);
  float y = h - s * (margin / 2 + titleLine / 2);
  if (!curve.title.empty()) {
    setText(painter, ground, titleSize * s, 0.85, true);
    painter->DrawString(std::round(margin * s), std::round(y), curve.title.c_str());
    y -= s * (titleLine + keyLine) / 2;
  }
  paintKey(painter, y);
  paintMarks(painter);
  paintAxisTitles(painter);
  const auto lines = definitionLines();
  setText(painter, ground, smallSize * s, 0.6);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto below = static_cast<float>(lines.size() - 1 - k);
    painter->DrawString(std::round(margin * s), std::round(s * (margin / 2 + smallLine * (below + 0.5F))),
                        lines[k].c_str());
  }
  return true;
}

void ChartFrame::paintKey(vtkContext2D* painter, float top) const {
  const float step = keyLine * scale;
  const auto rows = keyRows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    paintKeyRow(painter, rows[k], std::round(top - static_cast<float>(k) * step));
}

void ChartFrame::paintKeyRow(vtkContext2D* painter, const std::vector<std::size_t>& row, float y) const {
  const float s = scale;
  float x = std::round(margin * s);
  for (const std::size_t k : row) {
    const SeriesStyle style = styleOf(k);
    const bool scatter = curve.series[k].scatter;
    const float sample = (scatter ? pointWidth : sampleWidth) * s;
    painter->GetPen()->SetColor(style.colour[0], style.colour[1], style.colour[2], 255);
    painter->GetPen()->SetLineType(style.line);
    painter->GetPen()->SetWidth(2 * s);
    if (!scatter) painter->DrawLine(x, y, x + sample, y);
    if (style.marker != vtkPlotPoints::NONE) {
      float middle[] = {x + sample / 2, y};
      painter->GetPen()->SetWidth(style.size * s);
      painter->GetPen()->SetLineType(vtkPen::SOLID_LINE);
      painter->GetBrush()->SetColor(style.colour[0], style.colour[1], style.colour[2], 255);
      painter->DrawMarkers(style.marker, false, middle, 1);
    }
    setText(painter, ground, keySize * s, 0.8);
    const std::string& name = curve.series[k].name;
    painter->DrawString(std::round(x + sample + sampleGap * s), y, name.c_str());
    x += std::round(sample + sampleGap * s + widthOf(painter, name) + entryGap * s);
  }
}

ChartFrame::PlotArea ChartFrame::plotArea() const {
  vtkAxis* bottom = chart->GetAxis(vtkAxis::BOTTOM);
  vtkAxis* left = chart->GetAxis(vtkAxis::LEFT);
  return {bottom->GetPoint1()[0], bottom->GetPoint2()[0], left->GetPoint1()[1], left->GetPoint2()[1]};
}

void ChartFrame::paintAxisTitles(vtkContext2D* painter) const {
  const float s = scale;
  const PlotArea area = plotArea();
  setText(painter, ground, axisSize * s, 0.8);
  painter->GetTextProp()->SetJustificationToCentered();
  const float belowAxis = margins().bottom - axisLine * s / 2;
  painter->DrawString(std::round((area.x0 + area.x1) / 2), std::round(belowAxis), xTitle.c_str());
  // A title longer than its axis may go on below it, where there is room; then its letters get smaller.
  const float lowest = margins().bottom - axisLine * s, room = area.y1 - lowest;
  const float size =
      std::clamp(axisSize * s * room / widthOf(painter, yTitle), 0.75F * axisSize * s, axisSize * s);
  setText(painter, ground, size, 0.8);
  painter->GetTextProp()->SetJustificationToCentered();
  const float half = widthOf(painter, yTitle) / 2;
  const float y = std::min((area.y0 + area.y1) / 2, area.y1 - half);
  painter->GetTextProp()->SetOrientation(90);
  painter->DrawString(std::round(s * (margin / 2 + axisLine / 2)), std::round(y), yTitle.c_str());
  painter->GetTextProp()->SetOrientation(0);
}

void ChartFrame::paintMarks(vtkContext2D* painter) const {
  const float s = scale, gap = 6 * s, line = 17 * s;
  const PlotArea area = plotArea();
  struct Label {
    float x, y, wide;
    const std::string* text;
  };
  std::vector<Label> labels;
  setText(painter, ground, markSize * s, 0.65);
  const auto ink = inkOn(ground, 0.55);
  const Rgb paper = rgb(ground);
  painter->GetPen()->SetColorF(ink[0], ink[1], ink[2]);
  painter->GetPen()->SetLineType(vtkPen::DASH_LINE);
  painter->GetPen()->SetWidth(1.3F * s);
  for (const auto& mark : curve.marks) {
    double range[2];
    chart->GetAxis(mark.vertical ? vtkAxis::BOTTOM : vtkAxis::LEFT)->GetUnscaledRange(range);
    const auto share = static_cast<float>((mark.position - range[0]) / (range[1] - range[0]));
    if (!(share >= 0 && share <= 1)) continue;
    const float wide = widthOf(painter, mark.label);
    if (mark.vertical) {
      const float x = std::round(area.x0 + share * (area.x1 - area.x0));
      painter->DrawLine(x, area.y0, x, area.y1);
      labels.push_back(
          {x + gap + wide > area.x1 ? x - gap - wide : x + gap, area.y1 - 0.7F * line, wide, &mark.label});
    } else {
      const float y = std::round(area.y0 + share * (area.y1 - area.y0));
      painter->DrawLine(area.x0, y, area.x1, y);
      labels.push_back(
          {area.x1 - wide - gap, y + (y + line > area.y1 ? -0.6F : 0.6F) * line, wide, &mark.label});
    }
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    Label& label = labels[k];
    for (std::size_t other = 0; other < k; ++other) // steps down until it is clear of those before
      if (std::abs(label.y - labels[other].y) < 0.9F * line &&
          label.x < labels[other].x + labels[other].wide + gap &&
          labels[other].x < label.x + label.wide + gap) {
        label.y = labels[other].y - line;
        other = static_cast<std::size_t>(-1);
      }
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColor(paper[0], paper[1], paper[2], 215);
    painter->DrawRect(label.x - gap / 2, label.y - line / 2, label.wide + gap, line);
    painter->DrawString(std::round(label.x), std::round(label.y), label.text->c_str());
  }
}

} // namespace sandglass::vis
