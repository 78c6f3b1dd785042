"""PDMS that remembers
===================

What a viscoelastic substrate would add to the experiment of Wu et al. (Soft Matter, 2020): film, friction of the liquid and
of the substrate, and what their measurements say of it.

A glass ball of 2 mm slides over PDMS (Sylgard 184, 10:1) of about 3 MPa under 18.6 to 238 mN at 0.025 to 1 mm/s; the liquid,
taken with 2 Pa s, is PDMS base. Published numbers on how much the modulus of PDMS rises with the rate of loading do not agree.
Lötters et al. (J. Micromech. Microeng. 7, 145, 1997) found virtually no change with frequency. Wang, Volinsky & Gallant
(J. Appl. Polym. Sci. 132, 41384, 2015; mixed 5:1) found 1.5 MPa when a tip is pressed in slowly, and 3.6 MPa when it
oscillates. Kunzemann et al. (arXiv:2402.07555) have fitted a Prony series to Sylgard 184.

The moduli of the first part are **synthetic**: from 3 MPa to 2.4 times as much, the ratio of Wang et al., spread evenly over
five decades of time. Which times there are is an assumption. So the first part shows the most that the published numbers
allow, and then asks the experiment. The last part takes the **published** series of another silicone rubber.
"""

import math

import softlube
from softlube.plots.experiments import plot_stribeck
from softlube.plots.moduli import plot_substrate

fit = softlube.fit_substrate("data/pdms_moduli.csv")
print(fit.summary())
plot_substrate(fit, "pdms_memory_moduli.png")

# %%
# The ball's contact has a radius of 0.34 mm. At 0.1 mm/s it loads the PDMS at about 0.3 rad/s, in the middle of the data. The
# relaxed PDMS, as the paper has it, against the one that remembers:

rig = {"radius": "2 mm", "viscosity": "2 Pa s", "motion": softlube.Sliding("0.1 mm/s"), "load": "100 mN"}
relaxed = softlube.HalfSpace(fit.relaxed)
elastic = softlube.Contact(**rig, substrate=relaxed).solve()
solution = softlube.Contact(**rig, substrate=fit.substrate).solve(accuracy=5e-3)
found = solution.dimensional
for name in ("film_center", "film_min", "friction_total"):
    print(f"{name}: {found[name]} with memory, {elastic.dimensional[name]} without")
share = float(found["friction_hysteresis"]) / float(found["friction_total"])
print(f"share of the substrate in the friction: {share:.2f}")
modulus = fit.complex_modulus(0.3)
rule = 3 / 16 * math.pi * modulus.imag / modulus.real * float(elastic.dimensional["contact_radius"]) / 2e-3
coefficient = float(found["friction_hysteresis"]) / 0.1
print(f"its friction coefficient: {coefficient:.4f}; by the loss tangent (Greenwood & Tabor 1958): {rule:.4f}")
solution.plot("pdms_memory_film.png")

# %%
# The film is thinner because PDMS that is loaded fast is harder. The liquid's friction hardly changes, and the substrate adds
# more than twice as much. The surface comes back late, so the ball sinks in ahead and the pressure pushes it back.
#
# Over the paper's speeds the liquid's friction rises like the speed to the power 0.4. That of the substrate is nearly the same
# at every speed: there is always some time that passes while a point crosses the contact.

contact = softlube.Contact(**rig, substrate=fit.substrate)
table = softlube.stribeck_curve(contact, slowest="0.0125 mm/s", fastest="0.5 mm/s", points=9, accuracy=1e-2)
plot_stribeck(table, "pdms_memory_stribeck.png", against="speed")
print(table[["entrainment_speed [m/s]", "friction_viscous [N]", "friction_hysteresis [N]"]].to_string(index=False))
first, last = table.iloc[0], table.iloc[-1]
growth, by_liquid = (float(last[name] / first[name]) for name in ("friction [N]", "friction_viscous [N]"))
print(f"over a factor of 40 in speed the friction grows by {growth:.1f}, its viscous part by {by_liquid:.1f}")

# %%
# Wu et al. found that the friction of 72 loads and speeds falls on one curve of β, that of the liquid alone, over which it
# grows by a factor of 40 to the power 0.44, or 5. So their PDMS cannot lose as much as this one. With a tenth of the memory:

tenth = [(term.weight / 10, term.time) for term in fit.terms]
little = softlube.Viscoelastic(fit.relaxed, prony=tenth)
found_little = softlube.Contact(**rig, substrate=little).solve(accuracy=5e-3).dimensional
share_little = float(found_little["friction_hysteresis"]) / float(found_little["friction_total"])
modulus_little = fit.relaxed + (modulus - fit.relaxed) / 10
print(f"loss tangent {modulus.imag / modulus.real:.3f}: share of the substrate {share:.2f}")
print(f"loss tangent {modulus_little.imag / modulus_little.real:.3f}: share of the substrate {share_little:.2f}")

# %%
# Even a loss tangent below 0.02 makes more than a quarter of the friction at this speed. Who fits the viscosity to the whole
# friction, with the friction of the liquid like the viscosity to the power 0.44, takes that part for the liquid's:

too_large = (1 - share_little) ** (-1 / 0.44)
print(f"viscosity fitted without the memory: {too_large:.1f} times too large")

# %%
# A published series
# ------------------
#
# Elite Double 32 (Zhermack) is a silicone rubber that cures by addition, as Sylgard 184 does: PDMS with a filler. Its Prony
# series of ten times is by Haque et al. (2018). It is taken here from the code of a study of sliding rubber, which names them:
# github.com/gabrielealbertini/elastodynamics_friction_squeaking, bimat_friction/generate_2d_dynamic.py. The paper by Haque et
# al. itself was not at hand.

elite = softlube.Viscoelastic(
    young_modulus="1.196 MPa",
    prony="0.477 MPa @ 49.9 ns; 0.328 MPa @ 483 ns; 0.221 MPa @ 3.55 us; 0.157 MPa @ 17.2 us; 0.113 MPa @ 60.4 us; "
    "0.127 MPa @ 228 us; 0.114 MPa @ 1.33 ms; 0.077 MPa @ 9.07 ms; 0.059 MPa @ 64.2 ms; 0.043 MPa @ 0.489 s",
)
relaxed = softlube.HalfSpace("1.196 MPa")
for speed in ("0.025 mm/s", "0.1 mm/s", "1 mm/s"):
    there = rig | {"motion": softlube.Sliding(speed)}
    plain = softlube.Contact(**there, substrate=relaxed).solve().dimensional
    found_elite = softlube.Contact(**there, substrate=elite).solve(accuracy=5e-3).dimensional
    thinner = 1 - float(found_elite["film_center"]) / float(plain["film_center"])
    more = float(found_elite["friction_total"]) / float(plain["friction_total"]) - 1
    share_elite = float(found_elite["friction_hysteresis"]) / float(found_elite["friction_total"])
    print(f"{speed}: film {thinner:.1%} thinner, friction {more:.0%} more; share of the substrate in it: {share_elite:.2f}")

# %%
# From the slowest to the fastest of the paper's speeds this rubber adds 9 to 23 % to the friction of the same rubber without
# memory, and takes 1 to 4 % of the film: less than the synthetic moduli, more than nothing. Only its slowest times count. At
# 1 mm/s a point takes 0.9 s to cross the contact, and seven of the ten times are shorter than two thousandths of that.
