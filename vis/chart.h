#pragma once
// Charts as files.

#include "analysis/result.h"
#include "vis/renderer.h"

#include <filesystem>

namespace sandglass::vis {

inline constexpr int chartWidth = 1200, chartHeight = 750; ///< [pixel]

/// Draws the curve and writes a PNG whose text chunks hold title, definition, provenance and numbers.
/// The second form makes a renderer for this one chart.
void writeChart(Renderer& renderer, const analysis::Curve& curve, const std::filesystem::path& file,
                int width = chartWidth, int height = chartHeight);
void writeChart(const analysis::Curve& curve, const std::filesystem::path& file,
                GlBackend backend = GlBackend::automatic);

} // namespace sandglass::vis
