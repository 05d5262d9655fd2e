"""Points of Sobol's sequence after scipy, as 32 binary digits: python sobol.py > tests/reference/sobol.csv"""

from scipy.stats import qmc

points = qmc.Sobol(4, scramble=False, bits=32).random(4096) * 2**32
print("index,x0,x1,x2,x3")
for index in [*range(40), *range(1000, 1010), *range(4086, 4096)]:
    print(index, *(int(x) for x in points[index]), sep=",")
