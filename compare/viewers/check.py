"""Reads a recording with the libraries of Foxglove and Rerun, and checks that both will draw what is in it.

    pip install mcap mcap-protobuf-support foxglove-sdk rerun-sdk==0.41.0
    python compare/viewers/check.py RUN.mcap

Foxglove: every `foxglove.*` schema is compared with that of Foxglove's SDK, field by field. Every message is decoded, and
held against what its 3D panel asks for: one frame that all share, times of the message and of the record that
agree and do not go back, attitudes of length 1, colours from 0 to 1, sizes that are not negative, points that fit their
stride, scene entities that are never replaced and never vanish, indices of triangles that exist.
Rerun: the file is converted by its own reader, and there must be points and poses for each vehicle, and something of the
world, on the time line. Ends with 1 if anything is wrong.
"""

import collections
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import foxglove.messages
from google.protobuf import descriptor_pb2
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

faults = collections.Counter()


def expect(right, what):
    """Counts a fault, and prints the first of each kind."""
    if not right:
        faults[what.split(":")[0]] += 1
        if faults[what.split(":")[0]] == 1:
            print(f"  FAULT {what}")


def types(data):
    """All messages of a set of descriptors: names, numbers and kinds of their fields."""
    found = {}
    for file in descriptor_pb2.FileDescriptorSet.FromString(data).file:
        for message in file.message_type:
            fields = {(f.name, f.number, f.type, f.label, f.type_name) for f in message.field}
            found[f"{file.package}.{message.name}"] = fields
    return found


def schemas(summary):
    for channel in sorted(summary.channels.values(), key=lambda c: c.topic):
        schema = summary.schemas[channel.schema_id]
        line = f"  {channel.topic:20} {schema.name:24} {summary.statistics.channel_message_counts.get(channel.id, 0):8}"
        if schema.name.startswith("foxglove."):
            theirs = types(getattr(foxglove.messages, schema.name.split(".")[1]).get_schema().data)
            ours = types(schema.data)
            wrong = [name for name in theirs if theirs[name] != ours.get(name)]
            expect(not wrong, f"schema of {channel.topic}: {', '.join(wrong)} differ from the SDK's")
            line += "  as in the SDK"
        print(line)


def pose(pose, topic):
    q = pose.orientation
    length = math.sqrt(q.x**2 + q.y**2 + q.z**2 + q.w**2)
    expect(abs(length - 1) < 1e-5, f"attitude: {topic} has one of length {length}")
    p = pose.position
    expect(all(map(math.isfinite, (p.x, p.y, p.z))), f"position: {topic} has {p.x}, {p.y}, {p.z}")


def color(c, topic):
    expect(all(0 <= x <= 1 for x in (c.r, c.g, c.b, c.a)), f"colour: {topic} has {c.r}, {c.g}, {c.b}, {c.a}")


def cloud(message, topic):
    size = {1: 1, 2: 1, 3: 2, 4: 2, 5: 4, 6: 4, 7: 4, 8: 8}
    ends = [f.offset + size[f.type] for f in message.fields]
    expect(max(ends) <= message.point_stride, f"stride: a field of {topic} lies behind {message.point_stride} B")
    expect(len(message.data) % message.point_stride == 0, f"stride: {topic} ends within a point")
    expect({"x", "y", "z"} <= {f.name for f in message.fields}, f"fields: {topic} lacks x, y or z")
    pose(message.pose, topic)


def scene(message, topic, entities):
    for e in message.entities:
        expect(e.id not in entities, f"entity: {e.id} of {topic} is there twice")
        entities.add(e.id)
        expect((e.lifetime.seconds, e.lifetime.nanos) == (0, 0), f"lifetime: {e.id} vanishes")
        for part in [*e.cubes, *e.spheres, *e.cylinders]:
            pose(part.pose, topic)
            color(part.color, topic)
            size = (part.size.x, part.size.y, part.size.z)
            expect(all(0 <= s < math.inf for s in size), f"size: {e.id} of {topic} has {size}")
        for part in e.cylinders:
            scales = (part.bottom_scale, part.top_scale)
            expect(all(0 <= s <= 1 for s in scales), f"scale: {e.id} of {topic} has {scales}")
        for part in e.triangles:
            pose(part.pose, topic)
            color(part.color, topic)
            expect(len(part.indices) % 3 == 0, f"triangles: {e.id} of {topic} has {len(part.indices)} indices")
            expect(max(part.indices, default=-1) < len(part.points), f"triangles: an index of {e.id} has no point")


def messages(reader):
    """Decodes and checks all; what was found of vehicles and world."""
    frames, entities, last, vehicles = set(), set(), {}, 0
    for schema, channel, record, message in reader.iter_decoded_messages():
        topic = channel.topic
        if schema.encoding != "protobuf":
            continue
        expect(last.get(topic, 0) <= record.log_time, f"order: {topic} goes back in time")
        last[topic] = record.log_time
        if schema.name.startswith("foxglove.") and hasattr(message, "timestamp"):
            time_ns = message.timestamp.seconds * 10**9 + message.timestamp.nanos
            expect(time_ns == record.log_time, f"time: {topic} says {time_ns} ns in a record of {record.log_time} ns")
        if schema.name in ("foxglove.PosesInFrame", "foxglove.PointCloud"):
            frames.add(message.frame_id)
        if schema.name == "foxglove.PosesInFrame":
            expect(len(message.poses) == vehicles, f"vehicles: {len(message.poses)} poses of {vehicles}")
            for one in message.poses:
                pose(one, topic)
        elif schema.name == "foxglove.PointCloud":
            cloud(message, topic)
            count = len(message.data) // message.point_stride
            expect(topic != "/poses/points" or count == vehicles, f"vehicles: {count} points of {vehicles}")
        elif schema.name == "foxglove.SceneUpdate":
            frames.update(e.frame_id for e in message.entities)
            scene(message, topic, entities)
        elif schema.name == "foxglove.RawImage":
            expect(message.step * message.height == len(message.data), f"image: {topic} is not {message.height} rows")
        elif schema.name == "simbeeotic.Vehicles":
            vehicles = len(message.paths)
    expect(len(frames) == 1, f"frames: {sorted(frames)}, not one")
    return vehicles, len(entities)


class Text(DecoderFactory):
    """Protobuf, and the one text of ROS 2."""

    def decoder_for(self, encoding, schema):
        if encoding == "cdr":
            return lambda data: data[8 : 8 + struct.unpack("<I", data[4:8])[0] - 1].decode()
        return super().decoder_for(encoding, schema)


def rerun(path):
    """What its reader makes of the file: the columns of each entity."""
    columns = collections.defaultdict(set)
    with tempfile.TemporaryDirectory() as folder:
        converted = pathlib.Path(folder) / "run.rrd"
        tool = [sys.executable, "-m", "rerun_cli"]
        subprocess.run([*tool, "mcap", "convert", path, "-o", converted], check=True, capture_output=True)
        listing = subprocess.run([*tool, "rrd", "print", converted], check=True, capture_output=True, text=True).stdout
    for entity, names in re.findall(r"\) - (\S+) - data columns: \[([^]]*)", listing):
        columns[entity].update(names.split())
    return columns


def main(path):
    with open(path, "rb") as file:
        reader = make_reader(file, decoder_factories=[Text()])
        print("Foxglove")
        schemas(reader.get_summary())
        vehicles, entities = messages(reader)
        print(f"  {vehicles} vehicles, {entities} entities of the world")
    print("Rerun")
    columns = rerun(path)
    for entity, column in [
        ("/poses", "InstancePoses3D:translations"),
        ("/poses", "InstancePoses3D:quaternions"),
        ("/poses/points", "Points3D:positions"),
        ("/poses/points", "Points3D:colors"),
    ]:
        expect(column in columns[entity], f"rerun: {entity} has no {column}")
    solids = [e for e, names in columns.items() if any(re.match("(Boxes|Cylinders|Ellipsoids)3D:", n) for n in names)]
    points = "Points3D:positions" in columns["/world/points"]
    print(f"  {len(columns)} entities, {len(solids)} of them solids; points of the world: {'yes' if points else 'no'}")
    expect(entities <= 1 or points or solids, "rerun: nothing of the world")
    print(f"{sum(faults.values())} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python check.py RUN.mcap")
    sys.exit(main(sys.argv[1]))
