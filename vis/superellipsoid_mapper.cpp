#include <vtk_glew.h>

#include "vis/superellipsoid_mapper.h"

#include "vis/superellipsoid_shaders.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>

namespace sandglass::vis {

vtkStandardNewMacro(SuperellipsoidMapper);

void SuperellipsoidMapper::GetShaderTemplate(std::map<vtkShader::Type, vtkShader*> shaders,
                                             vtkRenderer* renderer, vtkActor* actor) {
  Superclass::GetShaderTemplate(shaders, renderer, actor);
  shaders[vtkShader::Vertex]->SetSource(superellipsoidVertexShader);
  shaders[vtkShader::Geometry]->SetSource(superellipsoidGeometryShader);
}

void SuperellipsoidMapper::ReplaceShaderValues(std::map<vtkShader::Type, vtkShader*> shaders,
                                               vtkRenderer* renderer, vtkActor* actor) {
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(vertex, "//VTK::Camera::Dec", "uniform mat4 MCVCMatrix;");
  vtkShaderProgram::Substitute(fragment, "//VTK::System::Dec",
                               "//VTK::System::Dec\n"
                               "#extension GL_ARB_conservative_depth : enable\n"
                               "#ifdef GL_ARB_conservative_depth\n"
                               "layout(depth_greater) out float gl_FragDepth;\n"
                               "#endif\n");
  vtkShaderProgram::Substitute(fragment, "//VTK::Normal::Dec", superellipsoidFragmentDeclarations);
  vtkShaderProgram::Substitute(fragment, "//VTK::Normal::Impl", "");
  vtkShaderProgram::Substitute(fragment, "//VTK::PositionVC::Dec", "");
  vtkShaderProgram::Substitute(fragment, "//VTK::PositionVC::Impl",
                               "vec4 vertexVC = vec4(centreVSOutput + offsetVSOutput, 1.0);");
  vtkShaderProgram::Substitute(fragment, "//VTK::Depth::Impl", superellipsoidFragmentCode);
  shaders[vtkShader::Vertex]->SetSource(vertex);
  shaders[vtkShader::Fragment]->SetSource(fragment);
  // The sphere mapper's own replacements find none of their places any more, and VTK's general ones follow.
  Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void SuperellipsoidMapper::CreateVBO(vtkPolyData* data, vtkIdType points, unsigned char* colours,
                                     int colourComponents, vtkIdType colourCount, float* sizes,
                                     vtkIdType sizeCount, vtkRenderer* renderer) {
  for (const char* name : {"turn", "axes", "squareness"})
    VBOs->CacheDataArray((std::string(name) + "MC").c_str(), data->GetPointData()->GetArray(name), renderer,
                         VTK_FLOAT);
  Superclass::CreateVBO(data, points, colours, colourComponents, colourCount, sizes, sizeCount, renderer);
}

} // namespace sandglass::vis
