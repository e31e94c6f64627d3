# SPDX-License-Identifier: BSD-2-Clause
"""A pad on a plate that slides, in the form in which Abaqus/CAE writes decks."""
from assembled import Box

DISC, PAD = Box((4, 4, 1), (4, 4, 1)), Box((2, 2, 1), (2, 2, 1))


def _part(name, box, material, kind):
    nodes = "".join(
        f"{number:7d}, {x:12.4f}, {y:12.4f}, {z:12.4f}\n" for number, (x, y, z) in box.nodes.items()
    )
    rows = [[number, *corners] for number, corners in box.elements.items()]
    cells = "".join(", ".join(f"{one:3d}" for one in row) + "\n" for row in rows)
    bottom = "".join(f" {number},\n" for number in box.at(2, 0.0))
    return f"""**
*Part, name={name}
*Node
{nodes}*Element, type={kind}
{cells}*Nset, nset=Set-1, generate
  1,  {len(box.nodes)},   1
*Elset, elset=Set-1, generate
  1,  {len(box.elements)},   1
*Nset, nset=Bottom
{bottom}*Elset, elset=_Top_S2, internal, generate
  1,  {len(box.elements)},   1
*Surface, type=ELEMENT, name=Top
_Top_S2, S2
*Elset, elset=_Low_S1, internal, generate
  1,  {len(box.elements)},   1
*Surface, type=ELEMENT, name=Low
_Low_S1, S1
*Orientation, name=Ori-1
          1.,           0.,           0.,           0.,           1.,           0.
3, 0.
** Section: {material}
*Solid Section, elset=Set-1, orientation=Ori-1, material={material}
,
*End Part
"""


TEXT = f"""*Heading
** Job name: brake Model name: Model-1
** In the form of Abaqus/CAE
*Preprint, echo=NO, model=NO, history=NO, contact=NO
**
** PARTS
{_part("Disc", DISC, "Iron", "C3D8R")}{_part("Pad", PAD, "Lining", "C3D8I")}**
** ASSEMBLY
**
*Assembly, name=Assembly
**
*Instance, name=Disc-1, part=Disc
*End Instance
**
*Instance, name=Pad-1, part=Pad
          1.,           1.,           1.
*End Instance
**
*Node
      1,           2.,           2.,           4.
*Nset, nset=m_Set-2
 1,
*Nset, nset=_PickedSet7, internal, instance=Pad-1
 1,
*Nset, nset="Set A", instance=Disc-1, generate
  1,  10,   1
*Element, type=SpringA, elset=Springs/Dashpots-1-spring
1, Disc-1.30, Pad-1.1
*Spring, elset=Springs/Dashpots-1-spring

50.
*Element, type=MASS, elset=Inertia-1_MASS_
2, 1
*Mass, elset=Inertia-1_MASS_
0.5,
** Constraint: Constraint-1
*Coupling, constraint name=Constraint-1, ref node=m_Set-2, surface=Pad-1.Top
*Kinematic
1, 1
2, 2
3, 3
4, 4
5, 5
6, 6
*End Assembly
**
** ELEMENT CONTROLS
**
*Section Controls, name=EC-1, ELEMENT DELETION=NO, hourglass=ENHANCED
1., 1., 1.
*Amplitude, name=Amp-1
             0.,              0.,              1.,              1.
** MATERIALS
**
*Material, name=Iron
*Damping, alpha=1., beta=1e-07
*Density
 7.2e-09,
*Elastic
110000., 0.26
*Material, name=Lining
*Density
 2.5e-09,
*Elastic, type=ENGINEERING CONSTANTS
5000.,5000.,1500.,0.2,0.3,0.3,2000.,1500.
1500.,
** INTERACTION PROPERTIES
*Surface Interaction, name=IntProp-1
1.,
*Friction, slip tolerance=0.005
 0.,
*Surface Behavior, pressure-overclosure=HARD
** BOUNDARY CONDITIONS
** Name: BC-1 Type: Symmetry/Antisymmetry/Encastre
*Boundary
Disc-1.Bottom, ENCASTRE
** Name: BC-2
*Boundary
m_Set-2, 1, 1
m_Set-2, 2, 2
m_Set-2, 4, 4
m_Set-2, 5, 5
m_Set-2, 6, 6
** INTERACTIONS
*Contact Pair, interaction=IntProp-1, small sliding, type=SURFACE TO SURFACE, no thickness
Pad-1.Low, Disc-1.Top
** ----------------------------------------------------------------
** STEP: Step-1
*Step, name=Step-1, nlgeom=NO, inc=1000, unsymm=YES
Pressure of the pad
*Static
0.1, 1., 1e-05, 1.
** LOADS
*Dsload
Pad-1.Top, P, 1.
*Restart, write, frequency=0
*Output, field, variable=PRESELECT
*Output, history, variable=PRESELECT
*End Step
*Step, name=Step-2, nlgeom=NO, unsymm=YES
*Static
*Motion, rotation
Disc-1.Set-1, 3., 0., 0., 0., 0., 0., 1.
*End Step
*Step, name=Step-3, nlgeom=NO, unsymm=YES
*Static
*Change Friction, interaction=IntProp-1
*Friction
0.4,
*End Step
*Step, name=Step-4, nlgeom=NO, perturbation, unsymm=YES
*Frequency, eigensolver=Lanczos, sim=NO, acoustic coupling=on, normalization=displacement
10, , , , ,
*End Step
*Step, name=Step-5, nlgeom=NO, perturbation, unsymm=YES
*Complex Frequency, friction damping=NO
10, , ,
*End Step
"""
