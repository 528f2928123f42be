#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Calls an operation of the manager at an address, whose arguments are texts, and prints the name of the CORBA exception in the
answer, or None.   send_request.py ADDRESS OPERATION [TEXT...]"""
import re
import socket
import sys


def number(value):
    return value.to_bytes(4, "big")


def append_text(body, value):
    """A string of CDR: its length begins at a multiple of 4."""
    data = value.encode() + b"\0"
    return body + b"\0" * (-len(body) % 4) + number(len(data)) + data


def send_request(address, operation, *texts):
    """A request of GIOP 1.2, big-endian."""
    body = number(7) + b"\3\0\0\0" + number(0) + number(len("manager")) + b"manager"
    body = append_text(body, operation)
    body += b"\0" * (-len(body) % 4) + number(0)  # no service contexts
    if texts:
        body += b"\0" * ((4 - len(body)) % 8)  # behind the header of 12 bytes arguments begin at a multiple of 8
    for text in texts:
        body = append_text(body, text)
    with socket.create_connection((address, 2810), 10) as connection:
        connection.sendall(b"GIOP\1\2\0\0" + number(len(body)) + body)
        answer = connection.recv(4096)
    assert answer[:4] == b"GIOP", answer
    is_system_exception = answer[16:20] in (b"\2\0\0\0", number(2))
    return re.search(rb"IDL:omg.org/CORBA/(\w+):", answer)[1].decode() if is_system_exception else None


print(send_request(*sys.argv[1:]))
