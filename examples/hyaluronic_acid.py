"""Hyaluronic acid on PDMS
=======================

A liquid that thins with shear: from a rheometer's numbers to film and friction, and what a constant viscosity would have
said.

Hyaluronic acid makes the fluid of joints viscous, and is injected into those where it does not. Bonnevie, Galesso, Secchieri
& Bonassar (PLOS ONE 14, e0216702, 2019) measured six such products: all thin with shear, by the law of Carreau and Yasuda,
from viscosities at rest that differ by a factor of more than 100; and their friction on cartilage does not go with the
viscosity at rest, but with one at the shear rates of the film. The flow curve here is **synthetic**, in the middle of that
range: 1 Pa s at rest, with 3 % of scatter. The rig is that of Wu et al. (Soft Matter, 2020): a glass ball of 2 mm on PDMS
of 3 MPa.
"""

import softlube
from softlube.plots.experiments import plot_stribeck
from softlube.plots.rheometer import plot_liquid

fit = softlube.fit_liquid("data/hyaluronic_acid.csv")
print(fit.summary())
plot_liquid(fit, "hyaluronic_acid_flow.png")

# %%
# The law can be taken over as it is printed, or as the part that it is.

print(fit.python)
rig = {"radius": "2 mm", "young_modulus": "3 MPa", "load": "50 mN"}
contact = softlube.Contact(**rig, liquid=fit.liquid, motion=softlube.Sliding("1 mm/s"))
thinning = contact.solve()
print(thinning.summary())

# %%
# A constant viscosity, that at rest, is what a data sheet gives. Film and friction are then wrong by factors:

at_rest = softlube.Newtonian(fit.liquid.viscosity)
constant = softlube.Contact(**rig, liquid=at_rest, motion=softlube.Sliding("1 mm/s")).solve()
ratio = {}
for name in ("film_center", "film_min", "friction_total"):
    ratio[name] = float(constant.dimensional[name]) / float(thinning.dimensional[name])
    print(f"{name}: {ratio[name]:.2f} times as much with the viscosity at rest")

# %%
# A liquid of constant viscosity has a film that does not know how much of its motion is sliding. This one is thinner where it
# is sheared: in pure rolling, at the same entrainment speed of 0.5 mm/s, it has more of a film.

rolling = softlube.Contact(**rig, liquid=fit.liquid, motion=softlube.Rolling("0.5 mm/s", slide_to_roll=0)).solve()
gain = float(rolling.dimensional["film_center"]) / float(thinning.dimensional["film_center"])
print(f"centre film in pure rolling: {gain:.3f} times that in sliding")

# %%
# A Stribeck curve from 0.1 to 1000 mm/s of entrainment. With a constant viscosity film and friction would go like the speed to
# the powers 0.6 and 0.4; here the liquid thins as it is sheared faster, and both rise less.

table = softlube.stribeck_curve(contact, slowest="0.1 mm/s", fastest="1 m/s", points=25)
plot_stribeck(table, "hyaluronic_acid_stribeck.png", against="speed")
slow, fast = table.iloc[0], table.iloc[-1]
exponent = {}
for name in ("film_center [m]", "friction_coefficient"):
    import math

    exponent[name] = math.log(fast[name] / slow[name]) / math.log(
        fast["entrainment_speed [m/s]"] / slow["entrainment_speed [m/s]"]
    )
    print(f"{name} goes like the speed to the power {exponent[name]:.2f} from end to end")
