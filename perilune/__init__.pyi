"""The public names of `perilune`, each from the module that defines it: the one list, read by type checkers,
editors and `perilune/__init__.py`.
"""

from . import modal as modal
from .analysis.api.comparison import Comparison as Comparison, compare as compare
from .analysis.api.export import Exported as Exported, export as export
from .analysis.api.laws import Law as Law, law as law, synthesize as synthesize
from .analysis.api.own import new_block as new_block, new_system as new_system
from .analysis.api.plans import (
    HoverPlan as HoverPlan,
    LandingBound as LandingBound,
    plan_hover_transfer as plan_hover_transfer,
    plan_landing_bound as plan_landing_bound,
)
from .analysis.api.results.plots import plot_results as plot_results
from .analysis.api.results.stored import StoredResults as StoredResults, open_results as open_results
from .analysis.api.timing import benchmark as benchmark
from .analysis.common.errors import InputError as InputError
from .analysis.design.synthesis.outcome import SynthesisResult as SynthesisResult
from .analysis.design.trajectories.bounds import Landing as Landing
from .analysis.design.trajectories.path import PlanError as PlanError
from .analysis.design.trajectories.vehicle import Margins as Margins, Transfer as Transfer, Vehicle as Vehicle
from .analysis.runtime.system.fault import Fault as Fault
from .analysis.stability.injection.bench import StudyError as StudyError
from .analysis.verbs.batch import BatchResult as BatchResult, batch as batch
from .analysis.verbs.describe import describe as describe
from .analysis.verbs.inventory import inventory as inventory
from .analysis.verbs.merge import merge as merge
from .analysis.verbs.prepare import PreparedCampaign as PreparedCampaign, prepare as prepare
from .analysis.verbs.rare import RareResult as RareResult, rare as rare
from .analysis.verbs.replay import ReplayResult as ReplayResult, replay as replay
from .analysis.verbs.run import Result as Result, simulate as simulate
from .analysis.verbs.sensitivity import SensitivityResult as SensitivityResult, sensitivity as sensitivity
from .analysis.verbs.shard import ShardResult as ShardResult, shard as shard
from .analysis.verbs.stability import StabilityReport as StabilityReport, stability as stability
from .analysis.verbs.validate import validate as validate
from .analysis.verbs.worst import WorstResult as WorstResult, worst as worst
from .fmus_src.block import (
    Block as Block,
    DeclarationError as DeclarationError,
    Input as Input,
    Output as Output,
    Parameter as Parameter,
    State as State,
)
from .fmus_src.interfaces.allocation import Allocation as Allocation
from .fmus_src.interfaces.attitude_observer import AttitudeObserver as AttitudeObserver
from .fmus_src.interfaces.entry_control import EntryControl as EntryControl
from .fmus_src.interfaces.filtered_navigation import FilteredNavigation as FilteredNavigation
from .fmus_src.interfaces.gyro_steering import GyroSteering as GyroSteering
from .fmus_src.interfaces.inertial_navigation import InertialNavigation as InertialNavigation
from .fmus_src.interfaces.jet_allocation import JetAllocation as JetAllocation
from .fmus_src.interfaces.navigation import Navigation as Navigation
from .fmus_src.interfaces.orbital_control import OrbitalControl as OrbitalControl
from .fmus_src.interfaces.terminal_guidance import (
    CLAMPED as CLAMPED,
    GOOD as GOOD,
    NOT_CONVERGED as NOT_CONVERGED,
    NO_SOLUTION as NO_SOLUTION,
    TerminalGuidance as TerminalGuidance,
)
from .fmus_src.mathlib.vectors import (
    Vector as Vector,
    Vector2 as Vector2,
    Vector3 as Vector3,
    Vector4 as Vector4,
    cross as cross,
    dot as dot,
    norm as norm,
    vector as vector,
)
