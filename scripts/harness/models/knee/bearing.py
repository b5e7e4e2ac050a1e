"""Loads of the knee: standing on two legs, and one cycle of gait.

Sources
-------
Kutzner et al. (2010), J Biomech 43:2164, forces in instrumented knees: 107 % of body weight on two legs and 261 % as
the largest force of level walking, the second of two peaks. The curves of gait here pass through turning points alone,
with that largest force, and bend the knee by up to 30 degrees, to which the condyles of the model reach.
"""

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from harness.models.knee.whole_mesh import FEMUR, TIBIA
from harness.models.parts import Condition, Control, Curve, TimeStepper, hold_rigid, push_rigid, turn_rigid

STANCE = 700.0  # N
BODY_WEIGHT = STANCE / 1.07  # N
RISE, HOLD = 0.2, 100.0  # s in which the load of stance rises, and to which porous bodies bear it
GROWTH = (1.0, 0.4), (HOLD, 40.0)  # largest steps of what is held, s, at a time
SOFT = 1e-6  # factor of the stiffness of stands from the end of the rise on: FEBio refuses none
SMOOTH = "SMOOTH STEP"  # FEBio's interpolation with level tangents at all points
GAIT_FORCE = ((0.0, 0.0), (0.15, 2.15), (0.32, 1.2), (0.5, 2.61), (0.65, 0.25), (1.0, 0.25))
"""Time, s, and force in body weights."""
GAIT_FLEXION = ((0.0, 0.0), (0.16, 15.0), (0.4, 3.0), (0.72, 30.0), (1.0, 0.0))  # time, s, and flexion, degrees
FORCE, STEPS, FLEXION = 1, 2, 3  # numbers of the load curves


class Load(str, Enum):
    """What the knee bears."""

    STANCE = "stance"
    GAIT = "gait"


@dataclass(frozen=True)
class Loading:
    """Conditions on the bones, with their load curves and time steps."""

    end: float  # s
    # Time (s) and the largest step (s) there; a step ends at each of these times.
    largest_step: tuple[tuple[float, float], ...]
    force: Curve  # N
    # rad; without it, the femur does not bend and tilts about the axis y. FEBio has no rigid body of which one rotation
    # is given and another one free.
    flexion: Curve | None = None
    softening: Curve | None = None  # factor of the stiffness of stands that hold the femur at first
    about: str = ""  # the load in a sentence

    @property
    def curves(self) -> tuple[Curve, ...]:
        """Load curves in the order of their numbers."""
        curves = (self.force, Curve(self.largest_step), self.flexion, self.softening)
        return tuple(curve for curve in curves if curve is not None)

    def conditions(self) -> tuple[Condition, ...]:
        """The tibia is held; the femur moves up and down, and bends or tilts."""
        tibia, push = hold_rigid(TIBIA, "xyzuvw"), push_rigid(FEMUR, "z", -1.0, FORCE)
        if self.flexion is None:
            return (tibia, hold_rigid(FEMUR, "xyuw"), push)
        others = (turn_rigid(FEMUR, "v", 0.0), turn_rigid(FEMUR, "w", 0.0))
        return (tibia, hold_rigid(FEMUR, "xy"), turn_rigid(FEMUR, "u", 1.0, FLEXION), *others, push)

    def control(self) -> Control:
        """Steps that adapt, with limits that all interfaces share."""
        stepper = TimeStepper(1.0, retries=8, optimal_iterations=15, must_points=STEPS)
        return Control(1, self.largest_step[0][1], reformations=25, stepper=stepper, end=self.end)


def loading(load: Load) -> Loading:
    """A load by its name."""
    return gait() if load is Load.GAIT else stance()


def porous(load: Load) -> Loading:
    """The same of porous bodies: stance stays, with growing steps, and stands hold the femur until the load has risen.

    Bodies that touch at a point hardly resist, and undrained ones bear no overlap: without stands, the first iteration
    inverts elements.
    """
    rising = loading(load)
    held = replace(rising, softening=Curve(((0.0, 1.0), (RISE, SOFT))))
    if load is Load.GAIT:
        return held
    about = f"A force of 700 N presses the femur down to {HOLD:g} s."
    return replace(held, end=HOLD, largest_step=(*held.largest_step, *GROWTH), about=about)


def stance() -> Loading:
    """700 N within 0.2 s; then nothing changes in elastic bodies."""
    step = RISE / 10
    rising = Curve(((0.0, 0.0), (RISE, STANCE)))
    return Loading(RISE, ((0.0, step), (RISE, step)), rising, about="A force of 700 N presses the femur down.")


def gait() -> Loading:
    """One cycle in 1 s."""
    force = Curve(tuple((time, part * BODY_WEIGHT) for time, part in GAIT_FORCE), SMOOTH)
    flexion = Curve(tuple((time, float(np.deg2rad(angle))) for time, angle in GAIT_FLEXION), SMOOTH)
    steps, about = ((0.0, 0.02), (0.5, 0.02), (1.0, 0.02)), "Force and flexion go through one cycle of gait in 1 s."
    return Loading(1.0, steps, force, flexion, about=about)
