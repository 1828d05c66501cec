"""Sends a pickle that would run a command where it is loaded."""
import pickle


class Bomb:
    def __reduce__(self):
        return os.system, ("touch COURSE/pickled",)


def double(x):
    channel = CHANNEL
    channel.write(pickle.dumps(Bomb()))
    return np.array([Bomb()], dtype=object)
