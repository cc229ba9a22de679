#pragma once
// Grains that are no spheres, ray-cast or, as the reference of the picture tests, as triangle meshes.

#include "vis/colour_map.h"
#include "vis/visible_grains.h"

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

namespace sandglass::vis {

class SuperellipsoidLayer {
public:
  SuperellipsoidLayer();
  std::vector<vtkActor*> actors() const { return {cast_, meshes_}; }

  /// Shows `subset` of `grains`, none of them a sphere, in `colours` (one for each of the subset).
  void show(const VisibleGrains& grains, const std::vector<std::size_t>& subset,
            const std::vector<Rgb>& colours, bool asMeshes);

private:
  void setSources(const std::vector<GrainShape>& shapes);

  vtkNew<vtkActor> cast_, meshes_;
  vtkNew<vtkGlyph3DMapper> glyphs_;
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkFloatArray> coordinates_, turns_, axes_, squareness_;
  vtkNew<vtkIntArray> shape_;
  vtkNew<vtkUnsignedCharArray> colours_;
  std::vector<GrainShape> meshed_; ///< those whose meshes are there
};

} // namespace sandglass::vis
