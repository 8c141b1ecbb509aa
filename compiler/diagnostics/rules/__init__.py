"""Every kind of diagnostic, declared once: code, severity, message, and explanation of the rule.

There is a file of rows for each section of docs/diagnostics.md. Whoever reports something finds its
row as an attribute of this package, whatever section it is in.

Codes are stable: they are written in build logs and looked up with ``burnish explain``. The first
two digits name the section; a retired code is never used again.
"""

from .b00_files import *
from .b01_syntax import *
from .b02_names import *
from .b03_types import *
from .b04_values import *
from .b05_stages import *
from .b06_lights import *
from .b07_targets import *
from .b08_frames import *
from .b09_functions import *
