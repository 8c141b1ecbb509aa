"""The exceptions by which a subject or a tool refuses, so that its row has failed.

``conform.py`` makes rows of them. ``costs.py`` meets some of them earlier, as it prepares frames.
"""

from ...compiler.budget import BudgetError
from ..runner.codes import CodeError
from ..runner.drivers.device import DriverError
from ..runner.frames.checking import PlanError
from ..runner.instances.host_values import MissingValuesError
from ..runner.kernels import UndrawableError

REFUSALS = (BudgetError, CodeError, DriverError, MissingValuesError, PlanError, UndrawableError)
"""Their texts say why nothing can be drawn."""
