# SPDX-License-Identifier: BSD-2-Clause
"""Sets that join other sets by their numbers, such as those of SPCADD and LOAD. `joined`: the
numbers of the sets that each union joins."""


def opened(joined, selected):
    """Returns the numbers of the simple sets that a set comprises, and those of the unions."""
    simple, unions, rest = set(), set(), [selected]
    while rest:
        number = rest.pop()
        if number not in joined:
            simple.add(number)
        elif number not in unions:
            unions.add(number)
            rest += joined[number]
    return simple, unions


def in_itself(joined, unions):
    """Returns one of some unions that contains itself, directly or through others; None if there is
    none."""
    left = set(unions)
    while ends := {number for number in left if not left.intersection(joined[number])}:
        left -= ends
    if not left:
        return None
    number, passed = min(left), set()
    while number not in passed:
        passed.add(number)
        number = min(left.intersection(joined[number]))
    return number
