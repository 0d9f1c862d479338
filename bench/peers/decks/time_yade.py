# YADE on a state of the comparison: Hertz-Mindlin, Coulomb limit, elastic-plastic rolling moment, five plane walls.
# yade -n -x -j CORES time_yade.py, with STATE (CSV), WARM, STEPS and VERLET (bounds enlarged by that part of the radius)
# in the environment.
import math
import os
import time

from yade import utils

with open(os.environ["STATE"]) as file:
    head = dict(word.split("=") for word in file.readline()[1:].split())
    file.readline()
    rows = [[float(word) for word in line.split(",")] for line in file]
material = O.materials.append(FrictMat(density=float(head["rho"]), young=1e7, poisson=0.25, frictionAngle=math.atan(0.3)))
for row in rows:
    sphere = utils.sphere(row[1:4], row[4], material=material)
    sphere.state.vel, sphere.state.angVel = row[5:8], row[8:11]
    O.bodies.append(sphere)
for axis, place in ((2, 0.0), (0, 0.0), (0, float(head["lx"])), (1, 0.0), (1, float(head["ly"]))):
    O.bodies.append(utils.wall(place, axis, material=material))
# The rolling moment is limited to 0.1 R* F_n in the other programs and to eta R F_n here, R = 2 R*; their rolling
# stiffness is 400 N/m times R* squared.
contact = Ip2_FrictMat_FrictMat_MindlinPhys(en=0.8, krot=1e-4, eta=0.05)
bounds = InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=-float(os.environ["VERLET"]), targetInterv=100)
O.engines = [
    ForceResetter(), bounds,
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [contact],
                    [Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=True)]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, -9.81)),
]
O.dt = 1e-5
O.run(int(os.environ["WARM"]), True)
built, start = bounds.numAction, time.time()
O.run(int(os.environ["STEPS"]), True)
taken = time.time() - start
print("peer=yade loop=%.6f builds=%d coordination=%.4f ke=%.6g" % (
    taken, bounds.numAction - built, 2.0 * O.interactions.countReal() / len(rows), utils.kineticEnergy()))
