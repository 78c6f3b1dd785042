"""First contact
=============

A glass ball of 2 mm slides at 0.1 mm/s over rubber in a silicone oil under 100 mN. How thick is the film, and how large the
friction?
"""

import softlube

contact = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2 Pa s", speed="0.1 mm/s", load="100 mN")
solution = contact.solve()

# %%
# Every number carries its error. In SI units:

for name in ("indentation", "film_center", "film_min", "friction_total", "friction_coefficient"):
    print(f"{name:22} {solution.dimensional[name]}")

# %%
# The one number that rules the problem, and the film in the paper's normalisation:

print(f"beta = {solution.beta:.5g}, film at the centre {solution.film_center}")

# %%
# Friction is a number only together with the region that it is counted over:

for cutoff in (1.0, 2.0, 4.0):
    ratio = softlube.friction.total_within(solution, cutoff) / solution.friction_total
    print(f"within {cutoff:g} a: {1e6 * ratio * solution.dimensional['friction_total']:.1f} µN")

# %%
# The film and the pressure as a picture:

figure = solution.plot("first_contact.png")
