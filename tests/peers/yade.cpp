#include "tests/peers/yade.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace sandglass::peers {

namespace fs = std::filesystem;

namespace {

// Yade's contact constants are those of two materials in series: twice the constant each, and a damper
// without limit for the floor and for beads that are held fast, whose contacts have twice the reduced mass.
// Its velocities are half a step behind positions, as ours: the run begins with a step of no length for the
// forces of the start, and the energy is that of the mean of two half steps.
constexpr const char* body = R"(
import math, time

sections, section = {'Atoms': [], 'Velocities': []}, None
for line in open('grains.data'):
    words = line.split()
    if words and words[0] in sections:
        section = sections[words[0]]
    elif words and section is not None:
        section.append([float(w) for w in words])
speeds = {int(v[0]): v[1:] for v in sections['Velocities']}

angle = math.atan(friction)
bead = O.materials.append(ViscElMat(kn=2 * kn, ks=2 * ks, cn=2 * cn, cs=0, frictionAngle=angle, density=1))
O.periodic = True
O.cell.setBox(*[upper[k] - lower[k] for k in range(3)])
ground = O.materials.append(ViscElMat(kn=2 * kn, ks=2 * ks, cn=1e30, cs=0, frictionAngle=angle, density=1))
ids = []
for a in sections['Atoms']:
    held = a[1] == 2
    i = O.bodies.append(sphere([a[4 + k] - lower[k] for k in range(3)], radius, material=ground if held else bead,
                               fixed=held))
    if held:
        continue
    state = O.bodies[i].state
    state.mass, state.inertia = mass, Vector3(1, 1, 1) * 0.4 * mass * radius * radius
    state.vel, state.angVel = Vector3(*speeds[int(a[0])][:3]), Vector3(*speeds[int(a[0])][3:])
    ids.append(i)
if floor:
    size, parts = [upper[k] - lower[k] for k in range(3)], 3
    for i in range(parts):
        for j in range(parts):
            O.bodies.append(box((size[0] * (i + 0.5) / parts, size[1] * (j + 0.5) / parts,
                                 -lower[2] - 0.5 * radius),
                                (0.5 * size[0] / parts, 0.5 * size[1] / parts, 0.5 * radius),
                                material=ground, fixed=True))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb()],
                          verletDist=0.05 * radius),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()],
                    [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0, gravity=gravity),
]
O.dt = 1e-30
O.step()
for i in ids:
    state = O.bodies[i].state
    state.vel -= 0.5 * dt * (O.forces.f(i) / mass + Vector3(*gravity))
    state.angVel -= 0.5 * dt * O.forces.t(i) / state.inertia[0]
O.dt = dt
start = time.time()
O.run(steps, wait=True)
seconds = time.time() - start
before = [Vector3(O.bodies[i].state.vel) for i in ids]
O.step()
energy = sum(0.5 * mass * (0.5 * (O.bodies[i].state.vel + v)).squaredNorm() for i, v in zip(ids, before))
print('YADE %.9g %.17g' % (seconds, energy))
)";

} // namespace

std::string yadeVersion() {
  if (findProgram("yade").empty()) return {};
  std::istringstream in(runCommand(fs::temp_directory_path(), "yade --version").text);
  for (std::string line; std::getline(in, line);)
    if (const auto at = line.find("Yade version: "); at != std::string::npos)
      return "Yade " + line.substr(at + 14, line.find_last_not_of(' ') - at - 13);
  return "Yade of unknown version";
}

std::string yadeScript(const YadeScene& s, long long steps) {
  const auto three = [](const double* v) {
    return fmt::format("({:.17g}, {:.17g}, {:.17g})", v[0], v[1], v[2]);
  };
  // Damping is a rate per effective mass: half the mass of two equal grains.
  return fmt::format(
             "kn, ks, cn, friction = {:.17g}, {:.17g}, {:.17g}, {:.17g}\nradius, mass = {:.17g}, {:.17g}\n"
             "lower, upper, gravity = {}, {}, {}\ndt, steps, floor = {:.17g}, {}, {}\n",
             s.law.normalStiffness, s.law.tangentialStiffness, 0.5 * s.law.normalDamping * s.mass,
             s.law.friction, s.radius, s.mass, three(s.lower), three(s.upper), three(s.gravity), s.timeStep,
             steps, s.floor ? "True" : "False") +
         body;
}

YadeRun runYade(const fs::path& folder, const std::string& script, int threads) {
  if (!(std::ofstream(folder / "grains.py") << script))
    throw RunError(fmt::format("cannot write '{}'", (folder / "grains.py").string()));
  const ProgramOutput output = runCommand(folder, fmt::format("yade -n -x -j{} grains.py", threads));
  const auto at = output.text.rfind("YADE ");
  YadeRun run;
  if (at == std::string::npos ||
      !(std::istringstream(output.text.substr(at + 5)) >> run.seconds >> run.kineticEnergy))
    throw RunError("yade failed: " + output.text);
  return run;
}

} // namespace sandglass::peers
