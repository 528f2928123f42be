#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A network cable between two interfaces of this network namespace: carries each Ethernet frame from one to the other,
late or not at all, as told on standard input.   cable.py INTERFACE INTERFACE

    delay MS JITTER_MS LOSS     each frame waits for MS to MS + JITTER_MS, and is lost with probability LOSS
    down | up                   pulled out, plugged in again

What tc's netem does, which not every kernel has. Frames that wait may overtake each other, as there.
"""
import heapq
import os
import random
import select
import socket
import sys
import time

ETH_P_ALL = 3
PACKET_OUTGOING = 4
MAX_WAITING = 10_000  # frames; more are lost


def main():
    sockets = []
    for interface in sys.argv[1:3]:
        one = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
        one.bind((interface, 0))
        sockets.append(one)
    delay = jitter = loss = 0.0
    up = True
    waiting = []  # (due, number, socket, frame)
    number = 0
    print("ready", flush=True)
    while True:
        timeout = max(0.0, waiting[0][0] - time.monotonic()) if waiting else None
        readable, _, _ = select.select([0, *sockets], [], [], timeout)
        if 0 in readable:
            lines = os.read(0, 4096).decode()
            if not lines:
                return
            for line in lines.splitlines():
                words = line.split()
                if words[0] == "delay":
                    delay, jitter, loss = float(words[1]) / 1e3, float(words[2]) / 1e3, float(words[3])
                else:
                    up = words[0] == "up"
                    waiting.clear()
                print("done", flush=True)
        for i, one in enumerate(sockets):
            if one not in readable:
                continue
            frame, address = one.recvfrom(65536)
            if address[2] == PACKET_OUTGOING or not up or random.random() < loss or len(waiting) >= MAX_WAITING:
                continue
            number += 1
            heapq.heappush(waiting, (time.monotonic() + delay + random.random() * jitter, number, sockets[1 - i], frame))
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, target, frame = heapq.heappop(waiting)
            try:
                target.send(frame)
            except OSError:
                pass  # the interface at that end is down


if __name__ == "__main__":
    main()
