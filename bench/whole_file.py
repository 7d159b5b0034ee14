"""Files that are whole or not there: written beside the target, then renamed onto it."""

import contextlib
import os


@contextlib.contextmanager
def whole_file(path):
    """Gives the path to write to. What was at `path` stays there until the work in the `with` is
    done, and if it fails. A symbolic link is followed; a target that is no regular file (a pipe,
    /dev/stdout) is written in place, for a rename would replace the device."""
    target = os.path.realpath(path)
    if os.path.exists(target) and not os.path.isfile(target):
        yield path
        return
    folder, name = os.path.split(target)
    partial = os.path.join(folder, f".{name}.{os.getpid()}.partial")
    try:
        yield partial
        os.replace(partial, target)
    except OSError as error:
        raise OSError(error.errno, error.strerror, path) from error
    finally:
        if os.path.exists(partial):
            os.remove(partial)
