"""The public names of `perilune`, each from the module that defines it: the one list, read by type checkers,
editors and `perilune/__init__.py`.
"""

from . import modal as modal
from .analysis.design.orbits.starts import epoch as epoch
from .analysis.design.orbits.starts import orbit as orbit
from .analysis.design.trajectories.path import PlanError as PlanError
from .analysis.design.trajectories.vehicle import Landing as Landing
from .analysis.design.trajectories.vehicle import Margins as Margins
from .analysis.design.trajectories.vehicle import Transfer as Transfer
from .analysis.design.trajectories.vehicle import Vehicle as Vehicle
from .analysis.options.fault import Fault as Fault
from .analysis.stability.point.bench import StudyError as StudyError
from .analysis.verbs.batch import BatchResult as BatchResult
from .analysis.verbs.batch import batch as batch
from .analysis.verbs.bounds import TrialBounds as TrialBounds
from .analysis.verbs.bounds import bound_trials as bound_trials
from .analysis.verbs.compare import Comparison as Comparison
from .analysis.verbs.compare import compare as compare
from .analysis.verbs.compose import Composition as Composition
from .analysis.verbs.compose import compose as compose
from .analysis.verbs.describe import describe as describe
from .analysis.verbs.diff import Differences as Differences
from .analysis.verbs.diff import diff as diff
from .analysis.verbs.export import Exported as Exported
from .analysis.verbs.export import export as export
from .analysis.verbs.inventory import inventory as inventory
from .analysis.verbs.laws import Law as Law
from .analysis.verbs.laws import SynthesisResult as SynthesisResult
from .analysis.verbs.laws import law as law
from .analysis.verbs.laws import synthesize as synthesize
from .analysis.verbs.new import new_block as new_block
from .analysis.verbs.new import new_system as new_system
from .analysis.verbs.open_results import StoredResults as StoredResults
from .analysis.verbs.open_results import open_results as open_results
from .analysis.verbs.open_results import plot_results as plot_results
from .analysis.verbs.plans import HoverPlan as HoverPlan
from .analysis.verbs.plans import LandingBound as LandingBound
from .analysis.verbs.plans import plan_hover_transfer as plan_hover_transfer
from .analysis.verbs.plans import plan_landing_bound as plan_landing_bound
from .analysis.verbs.rare import RareResult as RareResult
from .analysis.verbs.rare import rare as rare
from .analysis.verbs.replay import ReplayResult as ReplayResult
from .analysis.verbs.replay import replay as replay
from .analysis.verbs.run import Result as Result
from .analysis.verbs.run import simulate as simulate
from .analysis.verbs.sensitivity import SensitivityResult as SensitivityResult
from .analysis.verbs.sensitivity import sensitivity as sensitivity
from .analysis.verbs.shard import PreparedCampaign as PreparedCampaign
from .analysis.verbs.shard import ShardResult as ShardResult
from .analysis.verbs.shard import merge as merge
from .analysis.verbs.shard import prepare as prepare
from .analysis.verbs.shard import shard as shard
from .analysis.verbs.show import ServedCampaigns as ServedCampaigns
from .analysis.verbs.show import show as show
from .analysis.verbs.stability import StabilityReport as StabilityReport
from .analysis.verbs.stability import stability as stability
from .analysis.verbs.system import System as System
from .analysis.verbs.validate import validate as validate
from .analysis.verbs.verify import Verifications as Verifications
from .analysis.verbs.verify import verify as verify
from .analysis.verbs.worst import WorstResult as WorstResult
from .analysis.verbs.worst import worst as worst
from .common.errors import InputError as InputError
from .fmus_src.actuators.gyro_steering import GyroSteering as GyroSteering
from .fmus_src.actuators.jet_allocation import JetAllocation as JetAllocation
from .fmus_src.block import (
    Block as Block,
)
from .fmus_src.bundles import Bundle as Bundle
from .fmus_src.bundles import Inputs as Inputs
from .fmus_src.bundles import Outputs as Outputs
from .fmus_src.control.entry_control import EntryControl as EntryControl
from .fmus_src.control.orbital_control import OrbitalControl as OrbitalControl
from .fmus_src.external_state import ExternalState as ExternalState
from .fmus_src.guidance.terminal_guidance import TerminalGuidance as TerminalGuidance
from .fmus_src.interfaces.allocation import Allocation as Allocation
from .fmus_src.interfaces.navigation import Navigation as Navigation
from .fmus_src.interfaces.ports.landing import TerminalStatus as TerminalStatus
from .fmus_src.interfaces.ports.landing import ThrustCommand as ThrustCommand
from .fmus_src.kernel.enumerations import Enumeration as Enumeration
from .fmus_src.kernel.enumerations import member as member
from .fmus_src.kernel.functions import (
    acos as acos,
)
from .fmus_src.kernel.functions import (
    asin as asin,
)
from .fmus_src.kernel.functions import (
    atan as atan,
)
from .fmus_src.kernel.functions import (
    atan2 as atan2,
)
from .fmus_src.kernel.functions import (
    cbrt as cbrt,
)
from .fmus_src.kernel.functions import (
    cos as cos,
)
from .fmus_src.kernel.functions import (
    cosh as cosh,
)
from .fmus_src.kernel.functions import (
    exp as exp,
)
from .fmus_src.kernel.functions import (
    exp2 as exp2,
)
from .fmus_src.kernel.functions import (
    expm1 as expm1,
)
from .fmus_src.kernel.functions import (
    fmod as fmod,
)
from .fmus_src.kernel.functions import (
    log as log,
)
from .fmus_src.kernel.functions import (
    log1p as log1p,
)
from .fmus_src.kernel.functions import (
    log2 as log2,
)
from .fmus_src.kernel.functions import (
    log10 as log10,
)
from .fmus_src.kernel.functions import (
    pow as pow,
)
from .fmus_src.kernel.functions import (
    sin as sin,
)
from .fmus_src.kernel.functions import (
    sinh as sinh,
)
from .fmus_src.kernel.functions import (
    tan as tan,
)
from .fmus_src.kernel.functions import (
    tanh as tanh,
)
from .fmus_src.kernel.integrators import (
    Forcing as Forcing,
)
from .fmus_src.kernel.integrators import (
    Translation as Translation,
)
from .fmus_src.kernel.integrators import (
    count_steps as count_steps,
)
from .fmus_src.kernel.integrators import (
    runge_kutta_4 as runge_kutta_4,
)
from .fmus_src.kernel.integrators import (
    runge_kutta_nystrom as runge_kutta_nystrom,
)
from .fmus_src.kernel.integrators import (
    simpson as simpson,
)
from .fmus_src.kernel.matrices import (
    Matrix as Matrix,
)
from .fmus_src.kernel.matrices import (
    block as block,
)
from .fmus_src.kernel.matrices import (
    identity as identity,
)
from .fmus_src.kernel.matrices import (
    matrix as matrix,
)
from .fmus_src.kernel.matrices import (
    zeros as zeros,
)
from .fmus_src.kernel.records import (
    Field as Field,
)
from .fmus_src.kernel.records import (
    Record as Record,
)
from .fmus_src.kernel.records import (
    replace as replace,
)
from .fmus_src.mathlib.vectors import (
    Vector as Vector,
)
from .fmus_src.mathlib.vectors import (
    Vector2 as Vector2,
)
from .fmus_src.mathlib.vectors import (
    Vector3 as Vector3,
)
from .fmus_src.mathlib.vectors import (
    Vector4 as Vector4,
)
from .fmus_src.mathlib.vectors import (
    cross as cross,
)
from .fmus_src.mathlib.vectors import (
    dot as dot,
)
from .fmus_src.mathlib.vectors import (
    norm as norm,
)
from .fmus_src.mathlib.vectors import (
    vector as vector,
)
from .fmus_src.navigation.attitude_observer import AttitudeObserver as AttitudeObserver
from .fmus_src.navigation.filtered_navigation import FilteredNavigation as FilteredNavigation
from .fmus_src.navigation.inertial_navigation import InertialNavigation as InertialNavigation
from .fmus_src.plants.spacecraft import Spacecraft as Spacecraft
from .fmus_src.plants.spacecraft import SpacecraftMotion as SpacecraftMotion
from .fmus_src.ports import Port as Port
from .fmus_src.units import deg as deg
from .fmus_src.variables import (
    DeclarationError as DeclarationError,
)
from .fmus_src.variables import (
    Input as Input,
)
from .fmus_src.variables import (
    Output as Output,
)
from .fmus_src.variables import (
    Parameter as Parameter,
)
from .fmus_src.variables import (
    State as State,
)
