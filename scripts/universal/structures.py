"""320 structures, and last the equipment of the paper: python structures.py OUT.csv"""

import sys

import numpy as np
from scipy.stats import qmc

LOW, HIGH = np.array([np.log(0.4), np.log(0.04), 0.7]), np.array([np.log(8.0), np.log(0.5), 0.999])
points = qmc.scale(qmc.Sobol(3, scramble=True, seed=2015).random(512)[:320], LOW, HIGH)
with open(sys.argv[1], "w") as file:
    file.write("name,p,alpha,eta\n")
    for i, (ln_p, ln_alpha, eta) in enumerate(points):
        file.write(f"s{i:03d},{np.exp(ln_p):.5f},{np.exp(ln_alpha):.5f},{eta:.5f}\n")
    file.write("equipment,2.5,0.20,0.92\n")
