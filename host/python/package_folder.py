"""Prints the folder for packages under an installation prefix, relative to it: the one that this Python looks into."""
import os
import sys

prefix = os.path.realpath(sys.argv[1])
inside = [os.path.relpath(os.path.realpath(folder), prefix) for folder in sys.path
          if folder.endswith("-packages") and os.path.realpath(folder).startswith(prefix + os.sep)]
own = [folder for folder in inside if not folder.startswith("local" + os.sep)]  # /usr is not /usr/local
print(own[0] if own else "lib/python{}.{}/site-packages".format(*sys.version_info))
