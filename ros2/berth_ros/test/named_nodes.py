"""Several nodes before one robot, by the wall's clock, and what each of them said last."""
import time

import numpy as np
from berth_msgs.msg import LinkDistances, Separation
from living_robot import LivingRobot
from std_msgs.msg import Float64


class Heard:
    """What one node of this name said last."""

    def __init__(self, node, name):
        self.name, self.scale, self.distances, self.separation = name, None, None, None
        self.answers, self.scales = [], []  # with the time of the steady clock
        node.create_subscription(LinkDistances, f"{name}/distances", self.on_distances, 10)
        node.create_subscription(Separation, f"{name}/separation", lambda m: setattr(self, "separation", m), 10)
        node.create_subscription(Float64, f"{name}/speed_scale", self.on_scale, 10)

    def on_distances(self, message):
        self.distances = message
        self.answers.append((time.monotonic(), message))

    def on_scale(self, message):
        self.scale = message.data
        self.scales.append((time.monotonic(), message.data))

    def forget(self):
        del self.answers[:], self.scales[:]

    def goes(self):
        return self.scale == 1 and self.distances is not None and self.distances.status == LinkDistances.OK

    def stands(self):
        return (self.scale == 0 and self.distances.status == LinkDistances.STALE
                and all(np.isnan(link.distance_m) for link in self.distances.links))

    def __str__(self):
        text = self.separation.text if self.separation else ""
        return f"{self.name}: scale {self.scale}, status {self.distances and self.distances.status}, {text!r}"


class NamedNodes(LivingRobot):
    """Several nodes of these names before one robot, by the wall's clock. Each tells at NAME/distances and so on."""

    names = ()

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.heard = {name: Heard(cls.node, name) for name in cls.names}

    def advance(self):
        type(self).now_s = time.time()

    def say(self, *names):
        return [str(self.heard[name]) for name in names]

    def expect_goes(self, *names):
        self.assertTrue(self.until(lambda: all(self.heard[name].goes() for name in names)), self.say(*names))

    def expect_stands(self, what, *names, cause="", within_s=0.2, **step):
        end = time.monotonic() + within_s
        while time.monotonic() < end:
            self.step(**step)
        said = self.say(*names)
        print(f"{what}: {said}")
        self.assertTrue(all(self.heard[name].stands() for name in names), f"{what}: {said}")
        self.assertTrue(all(cause in self.heard[name].separation.text for name in names), f"{cause}: {said}")


# What lets a robot that stands still go on at full speed.
MAY_GO = {"cameras": ["front"], "separation.monitor": True, "separation.no_reading": "ignore", "separation.not_seen": "ignore",
          "separation.unknown": "ignore", "separation.human_speed_m_s": 0.1, "separation.intrusion_m": 0.0, "evaluation.min_seen_share": 0.0}


def remaps(name):
    return [(topic, f"{name}/{topic}") for topic in ("distances", "separation", "speed_scale")]
