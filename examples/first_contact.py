"""First contact, and its errors
=============================

A glass ball of 2 mm slides at 0.1 mm/s over rubber in a silicone oil under 100 mN. How thick is the film, how large is the
friction, and how far can the numbers be trusted?
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
# The error is an estimate of the distance from the exact solution of the equations. You can check it: ask for less accuracy and
# for more, and compare. The distance between the two is within the coarse solution's error.

coarse = contact.solve(accuracy=1e-2)
fine = contact.solve(accuracy=2e-4)
for name in ("film_center", "film_min", "friction_total"):
    distance = abs(coarse.dimensional[name] - fine.dimensional[name])
    print(f"{name:15} {coarse.dimensional[name]}, distance {float(distance):.1g}")

# %%
# This error says nothing about the model or about your inputs. A viscosity that is wrong by 10 % changes the film by 6 %:

thicker = softlube.Contact(radius="2 mm", young_modulus="3 MPa", viscosity="2.2 Pa s", speed="0.1 mm/s", load="100 mN").solve()
change = thicker.dimensional["film_center"] / solution.dimensional["film_center"] - 1
print(f"film at the centre {change:+.1%}")

# %%
# Friction is a number only together with the region that it is counted over:

for cutoff in (1.0, 2.0, 4.0):
    ratio = softlube.friction.total_within(solution, cutoff) / solution.friction_total
    print(f"within {cutoff:g} a: {1e6 * ratio * solution.dimensional['friction_total']:.1f} µN")

# %%
# The film and the pressure as a picture:

figure = solution.plot("first_contact.png")
