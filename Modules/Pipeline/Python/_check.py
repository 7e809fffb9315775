# SPDX-License-Identifier: BSD-3-Clause
"""What arguments may be: values that cannot be used are ValueError, one line that begins with the argument's name."""
import operator
import os
import reprlib

import numpy

LARGEST_SIDE = 1 << 20  # pixels
_LONGEST_PATH = 4096  # bytes
_LONGEST_LIST = 65536
_INTEGERS = range(-(1 << 31), 1 << 31)


def found(value):
    """What an error says was found: a short text on one line."""
    if value is None or isinstance(value, (bool, int, float, str, bytes, list, tuple, dict, set)):
        try:
            return " ".join(reprlib.repr(value).split())
        except Exception:  # of an element's own making
            if isinstance(value, int):
                return "a number of too many digits"
    return "an object of " + type(value).__name__


def fail(name, expected, value):
    raise ValueError(f"{name}: expected {expected}, found {found(value)}")


def raise_error(source):
    """Raises what an object of the library says went wrong: ValueError for a request or an input, else RuntimeError."""
    raise (ValueError if source.GetErrorCode() in (2, 3) else RuntimeError)(source.GetErrorMessage())


def text(name, value, expected="a name"):
    try:
        if isinstance(value, str) and value and "\0" not in value and value.encode():
            return value
    except UnicodeEncodeError:
        pass
    return fail(name, expected, value)


def path(name, value):
    """The bytes of a path."""
    try:
        given = os.fsencode(value)
    except (TypeError, ValueError):
        given = b""
    if not 0 < len(given) < _LONGEST_PATH or b"\0" in given or isinstance(value, bytes):
        fail(name, "a path", value)
    return given


def absolute(name, value):
    """The bytes of a path, which the current folder is no part of any more."""
    given = path(name, value)
    try:
        return os.path.abspath(given)
    except OSError as error:
        raise RuntimeError(f"{name}: the current folder: {error.strerror}") from None


def integer(name, value, among=_INTEGERS, expected="an integer"):
    try:
        if not isinstance(value, (bool, numpy.bool_)) and operator.index(value) in among:
            return operator.index(value)
    except TypeError:
        pass
    return fail(name, expected, value)


def switch(name, value):
    if not isinstance(value, (bool, numpy.bool_)):
        fail(name, "True or False", value)
    return bool(value)


def _sequence(value):
    return isinstance(value, (list, tuple, range)) or (isinstance(value, numpy.ndarray) and value.ndim == 1)


def size(value):
    """(width, height); (0, 0) for None."""
    if value is None:
        return 0, 0
    try:
        width, height = (integer("size", side) for side in value) if _sequence(value) else (0, 0)
    except ValueError:
        width, height = 0, 0
    if not (0 < width <= LARGEST_SIDE and 0 < height <= LARGEST_SIDE):
        fail("size", f"(width, height), two integers from 1 to {LARGEST_SIDE}; image size out of range", value)
    return width, height


def joined(words):
    """A list of names as the library takes it."""
    return ",".join(word.replace("\\", "\\\\").replace(",", "\\,") for word in words)


def names(name, value):
    """A name, or several, as the library takes them."""
    if isinstance(value, str):
        return joined([text(name, value)])
    if not _sequence(value) or len(value) == 0:
        fail(name, "a name or a list of names", value)
    return joined(text(name, one, "a list of names") for one in value)


def _word(name, value):
    if isinstance(value, (bool, numpy.bool_)):
        return "on" if value else "off"
    if isinstance(value, str):
        return text(name, value) if value else value
    if isinstance(value, (int, float, numpy.integer, numpy.floating)):
        try:
            return str(value)
        except ValueError:
            fail(name, "a number of fewer digits", value)
    return fail(name, "a number, a name, a list of them, or True or False", value)


def options(given):
    """Names and texts of options."""
    return [(text("options", name, "names"), _option(name, value)) for name, value in given.items()]


def _option(name, value):
    if _sequence(value) and len(value) <= _LONGEST_LIST:
        return joined(_word(name, one) for one in value)
    return _word(name, value)
