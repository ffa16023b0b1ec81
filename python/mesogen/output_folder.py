"""Where commands write: only into folders that are empty, or hold what the same command wrote before."""

import os


def foreign(folder, own):
    """Why nothing may be written into the folder, None if it may.

    own: function of the names in the folder, sorted; whether they tell that the same command wrote there before.
    """
    try:
        names = sorted(os.listdir(folder))
    except FileNotFoundError:
        return None
    except NotADirectoryError:
        return f"{folder} is a file: choose another --output"
    if not names or own(names):
        return None
    return f"{folder} is not empty and holds nothing of ours: choose another --output, such as a new folder in it"
