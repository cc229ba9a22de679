#include "vis/chart_layer.h"

#include "vis/chart_frame.h"
#include "vis/chart_range.h"
#include "vis/chart_style.h"
#include "vis/text_style.h"
#include "vis/ticks.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotArea.h>
#include <vtkPlotLine.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace sandglass::vis {

namespace {

// Pixels of a chart 540 high that a tick's label wants.
constexpr float xTickRoom = 60, yTickRoom = 24;

vtkSmartPointer<vtkTable> table(const std::vector<std::vector<double>>& columns) {
  static const char* const names[] = {"x", "low", "high"};
  auto result = vtkSmartPointer<vtkTable>::New();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(names[k]);
    for (const double v : columns[k])
      array->InsertNextValue(v);
    result->AddColumn(array);
  }
  return result;
}

/// The finite points of a series.
struct Points {
  std::vector<double> x, y, error;
};

Points finitePoints(const analysis::Series& series) {
  Points p;
  const std::size_t n = std::min(series.x.size(), series.y.size());
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
    p.x.push_back(series.x[i]);
    p.y.push_back(series.y[i]);
    const double e = i < series.error.size() ? series.error[i] : 0;
    p.error.push_back(std::isfinite(e) ? std::abs(e) : 0);
  }
  return p;
}

void addBand(vtkChartXY* chart, const Points& p, const Rgb& c) {
  std::vector<double> low(p.y), high(p.y);
  for (std::size_t i = 0; i < p.y.size(); ++i)
    low[i] -= p.error[i], high[i] += p.error[i];
  vtkNew<vtkPlotArea> band;
  band->SetInputData(table({p.x, low, high}));
  band->SetInputArray(0, "x");
  band->SetInputArray(1, "low");
  band->SetInputArray(2, "high");
  band->GetBrush()->SetColor(c[0], c[1], c[2], 60);
  band->GetPen()->SetLineType(vtkPen::NO_PEN);
  chart->AddPlot(band);
}

/// Every bar is a stem with two caps, each a segment of its own.
void addBars(vtkChartXY* chart, const Points& p, const Rgb& c, double cap, float penWidth) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double low = p.y[i] - p.error[i], high = p.y[i] + p.error[i];
    if (!(high > low)) continue;
    x.insert(x.end(), {p.x[i], p.x[i], p.x[i] - cap, p.x[i] + cap, p.x[i] - cap, p.x[i] + cap});
    y.insert(y.end(), {low, high, low, low, high, high});
  }
  if (x.empty()) return;
  vtkNew<vtkPlotLine> bars;
  bars->PolyLineOff();
  bars->SetInputData(table({x, y}), 0, 1);
  bars->SetColor(c[0], c[1], c[2], 255);
  bars->SetWidth(penWidth);
  chart->AddPlot(bars);
}

/// VTK draws no line through a single point.
void addLine(vtkChartXY* chart, const Points& p, const SeriesStyle& style, float s) {
  const bool single = style.line == vtkPen::NO_PEN || p.x.size() < 2;
  vtkSmartPointer<vtkPlotPoints> plot;
  if (single)
    plot = vtkSmartPointer<vtkPlotPoints>::New();
  else
    plot = vtkSmartPointer<vtkPlotLine>::New();
  plot->SetInputData(table({p.x, p.y}), 0, 1);
  plot->SetColor(style.colour[0], style.colour[1], style.colour[2], 255);
  plot->SetWidth((style.line == vtkPen::SOLID_LINE ? 2.0F : 2.5F) * s); // broken lines are paler
  if (!single) plot->GetPen()->SetLineType(style.line);
  plot->SetMarkerStyle(style.marker);
  plot->SetMarkerSize(style.size * s);
  chart->AddPlot(plot);
}

/// Returns the axis' title; ChartFrame writes it where it meets no label.
std::string setUpAxis(vtkAxis* axis, const analysis::Axis& meaning, const Span& span, int ticks,
                      const ChartFrame& frame) {
  const float s = frame.scale;
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(span.low, span.high);
  const Ticks nice = niceTicks(span.low, span.high, ticks);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (std::size_t k = 0; k < nice.values.size(); ++k) {
    positions->InsertNextValue(nice.values[k]);
    labels->InsertNextValue(nice.labels[k]);
  }
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle("");
  const auto ink = inkOn(frame.ground, 0.8), faint = inkOn(frame.ground, 0.10),
             line = inkOn(frame.ground, 0.55);
  setFont(axis->GetLabelProperties(), static_cast<int>(std::lround(13 * s)));
  axis->GetLabelProperties()->SetColor(ink[0], ink[1], ink[2]);
  axis->GetPen()->SetColorF(line[0], line[1], line[2]);
  axis->GetPen()->SetWidth(1.2F * s);
  axis->GetGridPen()->SetColorF(faint[0], faint[1], faint[2]);
  axis->GetGridPen()->SetWidth(1);
  return axisTitle(meaning.name, meaning.unit, nice.exponent);
}

} // namespace

ChartLayer::ChartLayer() {
  actor_->GetScene()->SetRenderer(renderer_);
  renderer_->AddActor(actor_);
}

void ChartLayer::show(const analysis::Curve& curve, int width, int height, const ChartLook& look) {
  renderer_->SetBackground(look.ground[0], look.ground[1], look.ground[2]);
  vtkNew<vtkChartXY> chart;
  vtkNew<ChartFrame> frame;
  frame->curve = curve;
  frame->chart = chart;
  frame->width = width;
  frame->height = height;
  frame->ground = look.ground;
  frame->scale = look.textScale * chartScale(width, height);
  const float s = frame->scale;

  const ChartRange range = chartRange(curve);
  const ChartMargins margins = frame->margins();
  const float wide = static_cast<float>(width) - margins.left - margins.right;
  const float high = static_cast<float>(height) - margins.bottom - margins.top;
  frame->xTitle = setUpAxis(chart->GetAxis(vtkAxis::BOTTOM), curve.x, range.x,
                            std::clamp(static_cast<int>(wide / (xTickRoom * s)), 2, 7), *frame);
  frame->yTitle = setUpAxis(chart->GetAxis(vtkAxis::LEFT), curve.y, range.y,
                            std::clamp(static_cast<int>(high / (yTickRoom * s)), 2, 6), *frame);
  std::vector<Points> points;
  for (const auto& series : curve.series)
    points.push_back(finitePoints(series));
  const double cap = 0.004 * (range.x.high - range.x.low);
  const auto hasError = [](const Points& p) {
    return std::any_of(p.error.begin(), p.error.end(), [](double e) { return e > 0; });
  };
  for (std::size_t k = 0; k < points.size(); ++k) // errors lie under all lines
    if (hasError(points[k]) && points[k].x.size() > markedPoints)
      addBand(chart, points[k], frame->styleOf(k).colour);
    else if (hasError(points[k]))
      addBars(chart, points[k], frame->styleOf(k).colour, cap, 1.4F * s);
  for (const bool ring : {true, false}) // rings are discs under the points
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!points[k].x.empty() && curve.series[k].ring == ring)
        addLine(chart, points[k], frame->styleOf(k), s);

  chart->SetAutoSize(false);
  chart->SetAutoAxes(false);
  for (const int side : {vtkAxis::TOP, vtkAxis::RIGHT})
    chart->GetAxis(side)->SetVisible(false);
  for (const int side : {vtkAxis::BOTTOM, vtkAxis::LEFT})
    chart->GetAxis(side)->SetVisible(true);
  chart->SetSize(vtkRectf(margins.left, margins.bottom,
                          static_cast<float>(width) - margins.left - margins.right,
                          static_cast<float>(height) - margins.top - margins.bottom));
  actor_->GetScene()->ClearItems();
  actor_->GetScene()->AddItem(chart);
  actor_->GetScene()->AddItem(frame);
  frame_ = frame;
  range_ = range;
}

ChartPlace ChartLayer::place() const {
  if (!frame_) return {};
  const auto area = frame_->plotArea();
  const double h = frame_->height;
  return {area.x0,      area.x1,       h - area.y1,  h - area.y0,
          range_.x.low, range_.x.high, range_.y.low, range_.y.high};
}

} // namespace sandglass::vis
