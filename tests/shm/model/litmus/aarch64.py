# SPDX-License-Identifier: Apache-2.0
"""Enumerates every execution that the AArch64 memory model allows for a small program of several threads.

Programs are C++ accesses, compiled as GCC and Clang do. Where they have a choice, this takes the weaker instruction:

    relaxed load, store     LDR, STR
    acquire load            LDAPR
    seq_cst load            LDAR
    release, seq_cst store  STLR
    read-modify-write       LDXR or LDAXR (acquire), STXR or STLXR (release)
    seq_cst fence           DMB ISH

The model is that of "Simplifying ARM Concurrency" (Pulte et al., POPL 2018), as in herd's aarch64.cat: an execution is allowed if
each location is coherent, no write comes between the two halves of a read-modify-write, and the order `ob` has no cycle.
Dependencies are left out: without them, more executions are allowed, so what is forbidden here is forbidden there.
"""
import collections
import itertools

ACQUIRES = ("acquire", "acq_rel", "seq_cst")
RELEASES = ("release", "acq_rel", "seq_cst")

Load = collections.namedtuple("Load", "register location order")
Store = collections.namedtuple("Store", "location value order")
Fence = collections.namedtuple("Fence", "order")
# `new` computes the value from the old one; None: the comparison has failed, and nothing is written.
Update = collections.namedtuple("Update", "register location new order")


def load(register, location, order="relaxed"):
    return Load(register, location, order)


def store(location, value, order="relaxed"):
    return Store(location, value, order)


def fence(order="seq_cst"):
    return Fence(order)


def exchange(register, location, value, order="relaxed"):
    return Update(register, location, lambda old: value, order)


def fetch_add(register, location, value, order="relaxed"):
    return Update(register, location, lambda old: old + value, order)


def compare_exchange(register, location, expected, value, order="relaxed"):
    return Update(register, location, lambda old: value if old == expected else None, order)


# kind: R, W or F. is_pair: the second half of a read-modify-write, directly behind the first.
Event = collections.namedtuple("Event", "thread kind location value order is_pair register")


def values_of(program, initial):
    """All values that each location may have. Each operation is executed once."""
    values = {location: {value} for location, value in initial.items()}
    operations = [op for op in itertools.chain(*program) if not isinstance(op, Fence)]
    for _, op in itertools.product(operations, operations):
        if isinstance(op, Store):
            values[op.location].add(op.value)
        elif isinstance(op, Update):
            values[op.location] |= {op.new(old) for old in values[op.location]} - {None}
    return values


def paths(thread, operations, values):
    """The events of a thread, for each choice of the values that it reads."""
    choices = [[(Event(thread, "F", None, None, op.order, False, None),)] if isinstance(op, Fence)
               else [(Event(thread, "W", op.location, op.value, op.order, False, None),)] if isinstance(op, Store)
               else [halves(thread, op, value) for value in sorted(values[op.location])] for op in operations]
    for path in itertools.product(*choices):
        yield list(itertools.chain(*path))


def halves(thread, op, value):
    read = Event(thread, "R", op.location, value, op.order, isinstance(op, Update), op.register)
    new = op.new(value) if isinstance(op, Update) else None
    if new is None:
        return (read,)
    return (read, Event(thread, "W", op.location, new, op.order, True, None))


def has_cycle(size, edges):
    waits = [0] * size
    after = [[] for _ in range(size)]
    for a, b in edges:
        after[a].append(b)
        waits[b] += 1
    ready = [event for event in range(size) if waits[event] == 0]
    done = 0
    while ready:
        done += 1
        for b in after[ready.pop()]:
            waits[b] -= 1
            if waits[b] == 0:
                ready.append(b)
    return done < size


def is_acquire(event):
    return event.kind == "R" and event.order in ACQUIRES


def is_release(event):
    return event.kind == "W" and event.order in RELEASES


def barrier_order(events):
    """`bob` of the model: the pairs of one thread that its instructions keep in order."""
    for a, b in itertools.combinations(range(len(events)), 2):
        first, second = events[a], events[b]
        if first.thread != second.thread or first.thread is None or "F" in (first.kind, second.kind):
            continue
        fences = {event.order for event in events[a + 1:b] if event.kind == "F"}
        is_ldar = second.kind == "R" and (second.order == "seq_cst" or (second.is_pair and is_acquire(second)))
        if (fences & {"seq_cst", "release"} or ("acquire" in fences and first.kind == "R") or is_acquire(first)
                or is_release(second) or (is_release(first) and is_ldar)):
            yield a, b


def executions(program, initial):
    """Yields (registers, memory at the end) of each allowed execution."""
    values = values_of(program, initial)
    threads = [list(paths(thread, operations, values)) for thread, operations in enumerate(program)]
    for path in itertools.product(*threads):
        events = [Event(None, "W", location, value, "relaxed", False, None) for location, value in initial.items()]
        events += itertools.chain(*path)
        yield from consistent(events)


def consistent(events):
    size = len(events)
    writes, reads = collections.defaultdict(list), []
    for index, event in enumerate(events):
        if event.kind == "W":
            writes[event.location].append(index)
        elif event.kind == "R":
            reads.append(index)
    same_thread = [(a, b) for a, b in itertools.combinations(range(size), 2)
                   if events[a].thread == events[b].thread and events[a].thread is not None]
    local = [(a, b) for a, b in same_thread if events[a].location == events[b].location and events[a].kind != "F"]
    pairs = [(a, a + 1) for a in reads if a + 1 < size and events[a + 1].kind == "W" and events[a + 1].is_pair
             and events[a].thread == events[a + 1].thread]
    bob = list(barrier_order(events))
    sources = [[w for w in writes[events[r].location] if events[w].value == events[r].value] for r in reads]
    # The first write of each location is the initial one.
    orders = [[(first, *rest) for rest in itertools.permutations(others)] for first, *others in writes.values()]
    orders = [order for order in itertools.product(*orders)
              if all(location.index(a) < location.index(b) for location in order for a, b in local
                     if a in location and b in location)]
    for order in orders:
        place = {write: index for location in order for index, write in enumerate(location)}
        coherence = [(a, b) for location in order for a, b in itertools.combinations(location, 2)]
        for chosen in itertools.product(*sources):
            source = dict(zip(reads, chosen))
            if any(place[source[r]] != place[w] - 1 for r, w in pairs):
                continue  # another write lies between both halves
            from_read = [(r, w) for r in reads for w in writes[events[r].location] if place[w] > place[source[r]]]
            read_from = [(source[r], r) for r in reads]
            if has_cycle(size, local + coherence + from_read + read_from):
                continue
            outside = [(a, b) for a, b in coherence + from_read + read_from if events[a].thread != events[b].thread]
            atomic = pairs + [(w, r) for w, r in read_from for _, second in pairs
                              if w == second and is_acquire(events[r]) and events[w].thread == events[r].thread]
            if not has_cycle(size, bob + outside + atomic):
                yield ({events[r].register: events[r].value for r in reads},
                       {events[location[-1]].location: events[location[-1]].value for location in order})
