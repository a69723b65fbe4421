"""Side by side with what one would use instead: `python -m benchmarks` prints one table.

Every ratio comes from one run on one machine, the contenders taking turns; no test asserts one.
"""
