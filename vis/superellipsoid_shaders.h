#pragma once
// GLSL of SuperellipsoidMapper. VC: view coordinates, the eye at the origin looking along -z. Own coordinates
// are those of the grain in units of its semi-axes.

namespace sandglass::vis {

inline constexpr const char* superellipsoidVertexShader = R"(//VTK::System::Dec
in vec4 vertexMC;
in vec4 turnMC;
in vec3 axesMC;
in vec2 squarenessMC;
//VTK::Camera::Dec
//VTK::Color::Dec
out vec3 centreVSOutput;
out vec3 axisXVSOutput;
out vec3 axisYVSOutput;
out vec3 axesVSOutput;
out vec2 squarenessVSOutput;

vec3 turned(vec3 v)
{
  vec3 u = turnMC.yzw;
  return v + 2.0 * cross(u, cross(u, v) + turnMC.x * v);
}

void main()
{
  //VTK::Color::Impl
  centreVSOutput = (MCVCMatrix * vertexMC).xyz;
  axisXVSOutput = mat3(MCVCMatrix) * turned(vec3(1.0, 0.0, 0.0));
  axisYVSOutput = mat3(MCVCMatrix) * turned(vec3(0.0, 1.0, 0.0));
  axesVSOutput = axesMC;
  squarenessVSOutput = squarenessMC;
  gl_Position = vec4(centreVSOutput, 1.0);
}
)";

inline constexpr const char* superellipsoidGeometryShader = R"(//VTK::System::Dec
layout(points) in;
layout(triangle_strip, max_vertices = 4) out;
uniform mat4 VCDCMatrix;
uniform int cameraParallel;
//VTK::Color::Dec
in vec3 centreVSOutput[];
in vec3 axisXVSOutput[];
in vec3 axisYVSOutput[];
in vec3 axesVSOutput[];
in vec2 squarenessVSOutput[];
flat out vec3 centreGSOutput;
flat out vec3 axisXGSOutput;
flat out vec3 axisYGSOutput;
flat out vec3 axesGSOutput;
flat out vec2 squarenessGSOutput;
out vec3 offsetGSOutput; // from the centre to this place of the rectangle, in the plane through the centre

void main()
{
  vec3 c = centreVSOutput[0];
  vec3 s = axesVSOutput[0];
  vec3 a = axisXVSOutput[0] * s.x;
  vec3 b = axisYVSOutput[0] * s.y;
  vec3 n = cross(axisXVSOutput[0], axisYVSOutput[0]) * s.z;
  // Offsets of the box' corners in the picture, measured in the plane through the centre.
  vec2 low = vec2(1.0e30), high = vec2(-1.0e30);
  float front = -1.0e30;
  bool aroundEye = false;
  for (int corner = 0; corner < 8; ++corner)
    {
    vec3 d = ((corner & 1) == 0 ? a : -a) + ((corner & 2) == 0 ? b : -b) + ((corner & 4) == 0 ? n : -n);
    vec3 p = c + d;
    front = max(front, p.z);
    vec2 offset = d.xy;
    if (cameraParallel == 0)
      {
      if (p.z > 0.01 * c.z) { aroundEye = true; }
      offset = p.xy * (c.z / p.z) - c.xy;
      }
    low = min(low, offset);
    high = max(high, offset);
    }
  if (aroundEye)
    {
    low = vec2(10.0 * c.z) - c.xy;
    high = vec2(-10.0 * c.z) - c.xy;
    }
  vec4 foremost = VCDCMatrix * vec4(0.0, 0.0, aroundEye ? c.z : front, 1.0);
  float depth = aroundEye ? -1.0 : max(foremost.z / foremost.w, -1.0);
  for (int k = 0; k < 4; ++k)
    {
    int i = 0;
    //VTK::Color::Impl
    vec3 offset = vec3((k & 1) == 0 ? low.x : high.x, (k & 2) == 0 ? low.y : high.y, 0.0);
    centreGSOutput = c;
    axisXGSOutput = axisXVSOutput[0];
    axisYGSOutput = axisYVSOutput[0];
    axesGSOutput = s;
    squarenessGSOutput = squarenessVSOutput[0];
    offsetGSOutput = offset;
    gl_Position = VCDCMatrix * vec4(c + offset, 1.0);
    gl_Position.z = depth * gl_Position.w;
    EmitVertex();
    }
  EndPrimitive();
}
)";

inline constexpr const char* superellipsoidFragmentDeclarations = R"(
uniform mat4 VCDCMatrix;
flat in vec3 centreVSOutput;
flat in vec3 axisXVSOutput;
flat in vec3 axisYVSOutput;
flat in vec3 axesVSOutput;
flat in vec2 squarenessVSOutput;
in vec3 offsetVSOutput;

// N(p) and its gradient, for |p| <= 1 and N >= 1 (see superellipsoid.h):
//   N = T^(1/b), T = S^(b/a) + |z|^b, S = |x|^a + |y|^a
vec4 normAndGradient(vec3 p, float a, float b)
{
  vec3 q = max(abs(p), vec3(1.0e-6));
  vec2 across = pow(q.xy, vec2(a));
  float s = max(across.x + across.y, 1.0e-30);
  float lateral = pow(s, b / a);
  float along = pow(q.z, b);
  float t = lateral + along;
  float n = pow(t, 1.0 / b);
  vec3 gradient = n / t * vec3(lateral / s * across, along) / q;
  return vec4(gradient * sign(p), n);
}
)";

inline constexpr const char* superellipsoidFragmentCode = R"(
  vec3 way = cameraParallel != 0 ? vec3(0.0, 0.0, -1.0) : normalize(vertexVC.xyz);
  mat3 fromOwn = mat3(axisXVSOutput, axisYVSOutput, cross(axisXVSOutput, axisYVSOutput));
  float unit = max(axesVSOutput.x, max(axesVSOutput.y, axesVSOutput.z)); // of distances along the ray
  vec3 from = (offsetVSOutput * fromOwn) / axesVSOutput;
  vec3 pace = (way * fromOwn) * unit / axesVSOutput;
  pace += vec3(lessThan(abs(pace), vec3(1.0e-9))) * 2.0e-9;
  vec3 one = (vec3(-1.0) - from) / pace, other = (vec3(1.0) - from) / pace;
  vec3 nearest = min(one, other), farthest = max(one, other);
  float t = max(nearest.x, max(nearest.y, nearest.z));
  float beyond = min(farthest.x, min(farthest.y, farthest.z));
  if (t >= beyond) discard;
  vec3 slope = vec3(0.0);
  bool met = false;
  if (squarenessVSOutput.x == 1.0 && squarenessVSOutput.y == 1.0)
    {
    float qa = dot(pace, pace), qb = dot(from, pace), qc = dot(from, from) - 1.0;
    float under = qb * qb - qa * qc;
    met = under >= 0.0;
    t = (-qb - sqrt(max(under, 0.0))) / qa;
    slope = from + t * pace;
    }
  else
    {
    float a = 2.0 / squarenessVSOutput.y, b = 2.0 / squarenessVSOutput.x;
    for (int k = 0; k < 24 && !met; ++k)
      {
      vec4 norm = normAndGradient(from + t * pace, a, b);
      slope = norm.xyz;
      float fall = dot(slope, pace);
      met = norm.w < 1.0001;
      if (met || fall > -1.0e-5 || t > beyond) break; // convex: from its lowest point on N only rises
      t += (1.0 - norm.w) / fall;
      }
    }
  if (!met) discard;
  vec3 normalVCVSOutput = normalize(fromOwn * (slope / axesVSOutput));
  vertexVC.xyz += t * unit * way;
  vec4 projected = VCDCMatrix * vertexVC;
  gl_FragDepth = 0.5 * projected.z / projected.w + 0.5;
)";

} // namespace sandglass::vis
