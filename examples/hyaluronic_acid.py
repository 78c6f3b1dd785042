"""Hyaluronic acid on PDMS
=======================

A liquid that thins with shear: from a rheometer's numbers to film and friction, and what a constant viscosity would have
said.

Hyaluronic acid makes the fluid of joints viscous, and is injected where that fails. Bonnevie, Galesso, Secchieri & Bonassar
(PLOS ONE 14, e0216702, 2019) measured six such products: all thin with shear by the law of Carreau and Yasuda, their
viscosities at rest differ by a factor of more than 100, and their friction tells more of how well they help than those do.
The flow curve here is **synthetic**, within that range: 1 Pa s at rest, with 3 % of scatter. The rig is that of Wu et al.
(Soft Matter, 2020): a glass ball of 2 mm on PDMS of 3 MPa.
"""

import math

import softlube
from softlube.plots.experiments import plot_stribeck
from softlube.plots.rheometer import plot_liquid

fit = softlube.fit_liquid("data/hyaluronic_acid.csv")
print(fit.summary())
plot_liquid(fit, "hyaluronic_acid_flow.png")

# %%
# The law can be pasted as it is printed, or taken as the part that it is. The film has shear rates far beyond those at which
# the liquid begins to thin, and softlube says what that does to film and friction.

print(fit.python)
rig = {"radius": "2 mm", "young_modulus": "3 MPa", "load": "50 mN"}
contact = softlube.Contact(**rig, liquid=fit.liquid, motion=softlube.Sliding("1 mm/s"))
thinning = contact.solve()
for name in ("film_center", "film_min", "friction_coefficient", "shear_rate_max"):
    print(name, thinning.dimensional[name])

# %%
# The viscosity at rest, which a data sheet gives, is wrong by factors:

at_rest = softlube.Newtonian(fit.liquid.viscosity)
constant = softlube.Contact(**rig, liquid=at_rest, motion=softlube.Sliding("1 mm/s")).solve()
ratio = {}
for name in ("film_center", "film_min", "friction_total"):
    ratio[name] = float(constant.dimensional[name]) / float(thinning.dimensional[name])
    print(f"{name}: {ratio[name]:.2f} times as much with the viscosity at rest")

# %%
# The film of a liquid of constant viscosity does not know how much of the motion is sliding. This one is thinner where it is
# sheared: at the same entrainment speed of 0.5 mm/s, nearly in pure rolling, there is more of it.

rolling = softlube.Contact(**rig, liquid=fit.liquid, motion=softlube.Rolling("0.5 mm/s", slide_to_roll=0.1)).solve()
gain = float(rolling.dimensional["film_center"]) / float(thinning.dimensional["film_center"])
print(f"centre film nearly in pure rolling: {gain:.3f} times that in sliding")

# %%
# A Stribeck curve. With a constant viscosity film and friction go about like the speed to the powers 0.6 and 0.4; here the
# liquid thins as it is sheared faster, and both rise less.

table = softlube.stribeck_curve(contact, slowest="0.1 mm/s", fastest="100 mm/s", points=25)
plot_stribeck(table, "hyaluronic_acid_stribeck.png", against="speed")
first, last = table.iloc[0], table.iloc[-1]
decades = math.log10(last["entrainment_speed [m/s]"] / first["entrainment_speed [m/s]"])
exponent = {name: math.log10(last[name] / first[name]) / decades for name in ("film_center [m]", "friction_coefficient")}
for name, value in exponent.items():
    print(f"{name} goes like the speed to the power {value:.2f} from end to end")
