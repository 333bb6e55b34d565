"""The error of each view of a log over time. python3 error_over_time.py session.lcm"""
import sys
import numpy as np
import seam

log = seam.read(sys.argv[1])
for peer in log.peers:
    error = log.error(peer)
    for second in range(int(log.time[0]), int(log.time[-1])):
        now = error[(log.time >= second) & (log.time < second + 1)]
        print(f"peer {peer}  {second:3} s  {1000 * np.sqrt(np.nanmean(now**2)):8.1f} mm RMS")
