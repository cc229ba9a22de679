#pragma once
// Superellipsoids as ray-cast impostors: for each grain one rectangle, in whose pixels a fragment shader
// follows the ray to the surface and gives exact silhouette, normal and depth. The input has one vertex for
// each grain and the point arrays "turn" (quaternion w, x, y, z), "axes" (semi-axes), "squareness" (e1, e2).
//
// The iteration is that of superellipsoid.h. The rectangle bounds the picture of the grain's box and lies at
// the depth of its foremost point, so that a surface never lies nearer than it: the shader says so
// (ARB_conservative_depth), and a graphics card skips what is hidden without running it.

#include <vtkOpenGLSphereMapper.h>

namespace sandglass::vis {

class SuperellipsoidMapper : public vtkOpenGLSphereMapper {
public:
  static SuperellipsoidMapper* New();
  vtkTypeMacro(SuperellipsoidMapper, vtkOpenGLSphereMapper);

protected:
  void GetShaderTemplate(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
                         vtkActor* actor) override;
  void ReplaceShaderValues(std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer,
                           vtkActor* actor) override;
  void CreateVBO(vtkPolyData* data, vtkIdType points, unsigned char* colours, int colourComponents,
                 vtkIdType colourCount, float* sizes, vtkIdType sizeCount, vtkRenderer* renderer) override;
};

} // namespace sandglass::vis
