#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A device for Kerf in one file: it sends poses and gets forces over UDP. Only Python's own modules are needed.

Replace `Handle` with your hardware: `pose()` reads the encoders, `apply()` sets the motors. Here it is a hand that does
an operation by itself, so that the connection can be tried without hardware:

    kerf run pedicle-awl.yaml --device udp &
    python3 device.py
"""
import argparse
import math
import socket
import struct
import sys
import time

HEADER = struct.Struct("<4sBBHQQ")  # magic, version, type, size, session, sequence
HELLO = struct.Struct("<32sII8d")  # name, abilities, buttons, limits
WELCOME = struct.Struct("<II")  # period [us], watchdog [ms]
POSE = struct.Struct("<3d4dII")  # position [m], rotation w x y z, buttons, 0
FORCE = struct.Struct("<QQ3d3d3d4dII")  # answered pose, tick, force [N], torque [N m], tool, flags, 0
TYPE_HELLO, TYPE_WELCOME, TYPE_POSE, TYPE_FORCE, TYPE_GOODBYE = 1, 2, 3, 4, 5
POSITION, ROTATION, FORCE_ABILITY = 1, 2, 4
RUNNING = 2  # flag of a force: it is of a tick, so the tool's pose counts
PERIOD = 1e-3  # [s]
WATCHDOG = 20e-3  # [s] without a force after which the motors must be off


class Connection:
    """Sends and receives Kerf's datagrams."""

    def __init__(self, host, port):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect((host, port))
        self.socket.setblocking(False)
        self.session = 0
        self.sequence = 0

    def send(self, kind, payload=b""):
        self.sequence += 1
        size = HEADER.size + len(payload)
        try:
            self.socket.send(HEADER.pack(b"KERF", 1, kind, size, self.session, self.sequence) + payload)
        except ConnectionRefusedError:
            pass  # Kerf does not listen yet

    def receive(self):
        """Returns the type and the payload of the newest datagram of Kerf, or None."""
        newest = None
        while True:
            try:
                data = self.socket.recv(512)
            except BlockingIOError:
                return newest
            except ConnectionRefusedError:  # of an earlier datagram that nobody took
                continue
            if len(data) < HEADER.size:
                continue
            magic, version, kind, size, session, _ = HEADER.unpack_from(data)
            if magic != b"KERF" or version != 1 or size != len(data):
                continue
            if kind == TYPE_WELCOME:
                self.session = session
            elif session != self.session:
                continue
            newest = kind, data[HEADER.size :]

    def connect(self, name, abilities, buttons, limits, seconds):
        """Says hello until Kerf answers. Returns whether it did."""
        payload = HELLO.pack(name.encode(), abilities, buttons, *limits)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.send(TYPE_HELLO, payload)
            time.sleep(0.05)
            answer = self.receive()
            if answer and answer[0] == TYPE_WELCOME:
                return True
        return False


def rotate(q, v):
    w, x, y, z = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx]


class Handle:
    """The handle of a device, with a simulated hand at it: a mass that a soft spring pulls along a path."""

    MASS, DAMPING, STIFFNESS = 0.6, 30.0, 300.0  # [kg], [N s/m], [N/m]
    PUSH = 2.5  # [N] maximum, at the device

    def __init__(self, path):
        self.path = path  # (distance along the tool [m], speed [m/s]) of each leg
        self.along = None  # direction of the tool, device frame
        self.position, self.velocity = 0.0, 0.0  # [m], [m/s] along it
        self.aim, self.leg, self.force = 0.0, 0, 0.0
        self.tip, self.start = 0.0, 0.0  # [m] along it, the latter at the start

    def is_done(self):
        return self.leg >= len(self.path)

    def pose(self):
        along = self.along or [0.0, 0.0, 0.0]
        return [self.position * a for a in along], [1.0, 0.0, 0.0, 0.0]

    def apply(self, force, tool_position, tool_rotation):
        """Takes the force on the hand [N] and the pose of the tool, both in the device's frame."""
        if self.along is None:
            self.along = rotate(tool_rotation, [0.0, 0.0, 1.0])
            self.start = sum(p * a for p, a in zip(tool_position, self.along))
        self.force = sum(f * a for f, a in zip(force, self.along))
        self.tip = sum(p * a for p, a in zip(tool_position, self.along)) - self.start

    def release(self):
        self.force = 0.0

    def step(self, dt):
        if self.along is None or self.is_done():
            return
        end, speed = self.path[self.leg]
        # Where bone holds the tool back, the aim runs ahead of it until the hand pushes with all its force.
        if abs(self.force) < self.PUSH:
            self.aim += math.copysign(speed * dt, end - self.tip)
        pull = self.STIFFNESS * (self.aim - self.position)
        self.velocity += (pull - self.DAMPING * self.velocity + self.force) / self.MASS * dt
        self.position += self.velocity * dt
        if abs(self.tip - end) < 0.1e-3:
            self.leg += 1
            self.aim = self.position


def serve(kerf, handle):
    """Exchanges poses and forces until the path is done or Kerf ends. Returns the exit code."""
    newest = due = time.monotonic()
    while not handle.is_done():
        due += PERIOD
        if (wait := due - time.monotonic()) > 0:
            time.sleep(wait)
        position, rotation = handle.pose()
        kerf.send(TYPE_POSE, POSE.pack(*position, *rotation, 1, 0))  # button 0: the motor runs
        answer = kerf.receive()
        if answer and answer[0] == TYPE_FORCE:
            values = FORCE.unpack(answer[1])
            if values[15] & RUNNING:
                handle.apply(values[2:5], values[8:11], values[11:15])
            newest = time.monotonic()
        elif answer and answer[0] == TYPE_GOODBYE:
            print("device.py: Kerf has ended the run")
            return 0
        if time.monotonic() - newest > WATCHDOG:
            handle.release()
        if time.monotonic() - newest > 5.0:
            print("device.py: Kerf is silent", file=sys.stderr)
            return 1
        handle.step(PERIOD)
    kerf.send(TYPE_GOODBYE)
    print("device.py: the path is done")
    return 0


def main():
    parser = argparse.ArgumentParser(description="A simulated device that does an operation along the tool's axis.")
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=4190)
    parser.add_argument("--wait", type=float, default=60.0, help="seconds to wait for Kerf")
    parser.add_argument("--path", default="10:2,0:10,27:1,0:10", help="legs, each DISTANCE in mm:SPEED in mm/s")
    arguments = parser.parse_args()
    path = [tuple(1e-3 * float(x) for x in leg.split(":")) for leg in arguments.path.split(",")]

    handle = Handle(path)
    kerf = Connection(arguments.host, arguments.port)
    # Peak and continuous force [N], torques [N m], stiffness [N/m], damping [N s/m], mass [kg], resolution [m]
    limits = (8.5, 2.1, 0.0, 0.0, 800.0, 5.0, 0.075, 30e-6)
    if not kerf.connect("Python example", POSITION | ROTATION | FORCE_ABILITY, 1, limits, arguments.wait):
        print("device.py: Kerf did not answer. Start `kerf run PROCEDURE.yaml --device udp`.", file=sys.stderr)
        return 1
    print("device.py: connected")
    try:
        return serve(kerf, handle)
    finally:
        handle.release()  # whatever has happened, the motors are off


if __name__ == "__main__":
    sys.exit(main())
