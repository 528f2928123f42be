#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes an interface compute checksums and cut segments itself (ethtool -K IFACE tx off tso off gso off gro off): frames
that a program carries on must be whole.   no_offload.py INTERFACE"""
import array
import fcntl
import socket
import struct
import sys

SIOCETHTOOL = 0x8946
for command in (0x17, 0x1F, 0x24, 0x2C):  # ETHTOOL_STXCSUM, STSO, SGSO, SGRO of linux/ethtool.h
    value = array.array("I", [command, 0])
    request = struct.pack("16sQ16x", sys.argv[1].encode(), value.buffer_info()[0])
    try:
        fcntl.ioctl(socket.socket(socket.AF_INET, socket.SOCK_DGRAM), SIOCETHTOOL, request)
    except OSError as error:
        print(f"{sys.argv[1]}: ethtool command {command:#x}: {error}")
