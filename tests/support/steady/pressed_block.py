# SPDX-License-Identifier: BSD-2-Clause
"""A block that a sliding plate presses from above: friction lifts its nodes one after the other."""
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]


def pressed_block(cells, modes, frictions):
    """The words of its options: `cells` along and across as for -mesh_set, the number of free
    modes, and the frictions of the sweep."""
    options = {
        "mesh_file": REPOSITORY / "meshes/layer.geo",
        "mesh_set": f"Lx=0.5,{cells}",
        "material_layer_young": "1e9",
        "material_layer_poisson": "0.3",
        "material_layer_density": "1000",
        "constraint_bottom_clamped": "xy",
        "contact_plate_pad": "top",
        "contact_plate_obstacle_velocity": "1,0,0",
        "contact_plate_obstacle_displacement": "0,-0.001,0",
        "report_fields": "off",
        "modes_count": str(modes),
        "flutter_friction": frictions,
    }
    return [word for name, value in options.items() for word in (f"-{name}", value)]
