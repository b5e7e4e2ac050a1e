"""Kinds of arrays."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ids = NDArray[np.int64]  # numbers of nodes, elements or facets, and places in other arrays
Mask = NDArray[np.bool_]
