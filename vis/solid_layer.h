#pragma once
// Superellipsoids, ray-cast or, as the reference of the picture tests, as triangle meshes.

#include "vis/solids.h"

#include <vtkActor.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

namespace sandglass::vis {

class SolidLayer {
public:
  SolidLayer();
  std::vector<vtkActor*> actors() const { return {cast_, meshes_}; }

  void show(const std::vector<Solid>& solids, bool asMeshes);

private:
  void setSources(const std::vector<Solid>& solids);

  vtkNew<vtkActor> cast_, meshes_;
  vtkNew<vtkGlyph3DMapper> glyphs_;
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkFloatArray> coordinates_, turns_, axes_, squareness_;
  vtkNew<vtkIntArray> shape_;
  vtkNew<vtkUnsignedCharArray> colours_;
  std::vector<GrainShape> meshed_; ///< those whose meshes are there
};

} // namespace sandglass::vis
