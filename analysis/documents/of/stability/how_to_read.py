"""Guide to the figures and tables of a loop."""

from ...common.quantities import MINUS

HOW_TO_READ = (
    "Frequencies are angular, in rad/s, up to the Nyquist frequency of the loop's sample period. Lines are L; small "
    "circles are the response measured in flight, where L is linearised. Diamonds mark gain margins, squares phase "
    "margins and peaks; the decisive ones are filled.",
    "Bode: bars are the decisive gain and phase margin, read at the dotted frequencies; the short dashed lines are "
    f"the margins required. Nyquist: the cross is {MINUS}1; the solid circle about it is the modulus margin, the "
    "dashed one its limit; dotted curves are the unit circle and negative frequencies; the arrow points to higher "
    f"frequencies. A loop is stable where the whole curve, from {MINUS}π/T to π/T, encircles {MINUS}1 "
    "counter-clockwise as often as the open loop has unstable poles.",
    "Nichols: the hatched diamond is the exclusion zone, with its corners at the required gain and phase margins; "
    "the dashed oval is the limit of the modulus margin.",
    "Sensitivities: S = 1/(1 + L) solid, T = L/(1 + L) dashed; the dashed horizontal line is the limit that the "
    "modulus margin sets on S.",
    "Poles: the solid circle is the unit circle, dotted lines have constant damping (0.2, 0.5, 0.8). Crosses are "
    "modes controllable and observable at the break point; triangles down are not controllable from it, triangles up"
    " not observable at it, squares neither. Poles on or outside the circle are in orange.",
    "Over trials: dashed is the limit, the triangle the worst trial; the hatched bar at the left counts unstable "
    "trials. Crosses are the nominal poles, dots those of all trials.",
    f"Harmonic balance: a limit cycle is predicted where L and {MINUS}1/N meet; filled dots are stable ones, rings "
    "unstable ones.",
    f"Encirclements, counter-clockwise positive: by Nyquist's criterion N of {MINUS}1 and P unstable poles of the "
    f"open loop leave P {MINUS} N unstable closed-loop poles, and stable is P = N. Integrators (z = 1) are passed on "
    "the outside: not among P. Disk margin: gain and phase may vary simultaneously within it.",
)
