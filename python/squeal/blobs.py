# SPDX-License-Identifier: BSD-2-Clause
"""Arrays as text that a browser unpacks."""
import base64
import zlib

import numpy as np

MOST_BYTES = 22_000_000  # of all arrays in one report


def blob(array):
    """Returns the bytes of an array, compressed, as base64."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(array).tobytes(), 9)).decode()


__all__ = ["MOST_BYTES", "blob"]
