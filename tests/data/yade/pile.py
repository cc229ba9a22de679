# Two sizes of grains fall on a plate: Yade 2023.02. Run with: yade -x -n pile.py
from yade import export, pack
O.materials.append(FrictMat(young=5e6, poisson=.3, frictionAngle=.5, density=2500))
O.bodies.append(utils.wall((0, 0, 0), axis=2))
sp = pack.SpherePack()
sp.makeCloud((-.01, -.01, 0), (.01, .01, .04), psdSizes=[.002, .003], psdCumm=[.4, 1], num=80, seed=1)
sp.toSimulation()
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                             [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
             NewtonIntegrator(gravity=(0, 0, -9.81), damping=.2),
             VTKRecorder(fileName='pile_', recorders=['spheres', 'velocity', 'id', 'materialId'], iterPeriod=2000)]
O.dt = .5 * PWaveTimeStep()
O.run(4001, True)
export.textExt('pile.txt', format='x_y_z_r_matId')
export.text('pile_xyzr.txt')
O.exitNoBacktrace() if hasattr(O, 'exitNoBacktrace') else None
