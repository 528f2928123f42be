// SPDX-License-Identifier: Apache-2.0
// Every verdict of the doctor, on file trees and kernel answers made for it.
#include "apps/tandem/doctor/checks.hpp"

#include <catch2/catch.hpp>

#include <cerrno>
#include <fstream>
#include <set>
#include <unistd.h>

using namespace tandem::doctor;

namespace {

/// A machine of files in a folder of its own, on which nothing is wrong until a test makes it so.
class Patient {
  public:
    Patient() {
        std::string name = (std::filesystem::temp_directory_path() / "tandem-doctor-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        machine.root = name;
        machine.answers = {.locked_limit = unlimited,
                           .realtime_limit = 90,
                           .files_limit = 1024,
                           .shm_bytes = gib,
                           .shm_free = gib,
                           .timer_slack_ns = 50'000,
                           .cores = 4,
                           .user = 1000};
        mount("tmpfs", "rw,nosuid,nodev,huge=within_size");
        file("/sys/kernel/mm/transparent_hugepage/shmem_enabled",
             "always within_size advise [never] deny force\n");
        file("/run/systemd/system/.keep", "");
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=no\n");
        file("/proc/sys/kernel/sched_rt_runtime_us", "-1\n");
        file("/proc/sys/kernel/sched_rt_period_us", "1000000\n");
        file("/proc/sys/fs/inotify/max_user_instances", "128\n");
        file("/proc/sys/fs/inotify/max_user_watches", "65536\n");
        file("/sys/devices/system/cpu/isolated", "2-3\n");
        file("/sys/devices/system/cpu/nohz_full", "2-3\n");
        file("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
        file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance\n");
        file("/proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian 6.1\n");
        file("/sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc\n");
        file("/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu tsc sse2\nbugs\t: x\n");
    }
    ~Patient() { std::filesystem::remove_all(machine.root); }
    Patient(const Patient&) = delete;
    Patient& operator=(const Patient&) = delete;

    void file(const std::string& name, const std::string& content) {
        const auto path = machine.path(name);
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << content;
    }
    void mount(const std::string& type, const std::string& options) {
        file("/proc/self/mounts", "proc /proc proc rw 0 0\ntmpfs /dev/shm ext4 rw 0 0\n" + type +
                                      " /dev/shm " + type + " " + options + " 0 0\n");
    }
    void no_file(const std::string& name) { std::filesystem::remove(machine.path(name)); }

    static constexpr std::uint64_t gib = std::uint64_t{1} << 30;
    Machine machine;
};

/// A warn or bad finding must say what to do, in one line; an ok one has nothing to say.
bool is(const Finding& finding, Verdict verdict, const std::string& seen) {
    INFO(finding.name << ": " << finding.seen << " - " << finding.advice);
    CHECK(finding.verdict == verdict);
    CHECK(finding.seen.find(seen) != std::string::npos);
    CHECK(finding.advice.empty() == (verdict == Verdict::ok));
    CHECK(finding.advice.find('\n') == std::string::npos);
    return finding.verdict == verdict;
}

} // namespace

TEST_CASE("a machine on which all is well gets nothing but ok") {
    const Patient patient;
    const auto findings = examine(patient.machine);
    CHECK(findings.size() == 20);
    std::set<std::string> names;
    for (const auto& finding : findings) {
        INFO(finding.name << ": " << finding.seen);
        CHECK(finding.verdict == Verdict::ok);
        CHECK_FALSE(finding.seen.empty());
        names.insert(finding.name);
    }
    CHECK(names.size() == findings.size());
}

TEST_CASE("a machine without any of the files is examined all the same") {
    Patient patient;
    std::filesystem::remove_all(patient.machine.root);
    CHECK(examine(patient.machine).size() == 20);
}

TEST_CASE("/dev/shm must be a tmpfs that can be written") {
    Patient patient;
    is(check_shm_mount(patient.machine), Verdict::ok, "tmpfs");
    patient.mount("ext4", "rw");
    is(check_shm_mount(patient.machine), Verdict::bad, "ext4");
    patient.mount("tmpfs", "ro,relatime");
    is(check_shm_mount(patient.machine), Verdict::bad, "read-only");
    patient.no_file("/proc/self/mounts");
    is(check_shm_mount(patient.machine), Verdict::bad, "nothing is mounted");
}

TEST_CASE("/dev/shm must have room for a link and should have room for images") {
    Patient patient;
    is(check_shm_space(patient.machine), Verdict::ok, "1 GiB free");
    patient.machine.answers.shm_free = std::uint64_t{64} << 20;
    is(check_shm_space(patient.machine), Verdict::warn, "64 MiB free of 1 GiB");
    patient.machine.answers.shm_free = std::uint64_t{1} << 20;
    is(check_shm_space(patient.machine), Verdict::bad, "1 MiB free");
}

TEST_CASE("huge pages depend on the mount unless the kernel forces or denies them") {
    Patient patient;
    const auto shmem = "/sys/kernel/mm/transparent_hugepage/shmem_enabled";
    is(check_huge_pages(patient.machine), Verdict::ok, "huge=within_size");
    patient.mount("tmpfs", "rw");
    is(check_huge_pages(patient.machine), Verdict::warn, "huge=never");
    patient.mount("tmpfs", "rw,huge=advise");
    is(check_huge_pages(patient.machine), Verdict::warn, "huge=advise");
    patient.file(shmem, "always within_size advise never deny [force]\n");
    is(check_huge_pages(patient.machine), Verdict::ok, "forced");
    patient.mount("tmpfs", "rw,huge=always");
    patient.file(shmem, "always within_size advise never [deny] force\n");
    is(check_huge_pages(patient.machine), Verdict::warn, "denied");
    patient.no_file(shmem);
    is(check_huge_pages(patient.machine), Verdict::warn, "not in this kernel");
}

TEST_CASE("RemoveIPC is read as logind reads it") {
    Patient patient;
    is(check_remove_ipc(patient.machine), Verdict::ok, "no (/etc/systemd/logind.conf)");
    SECTION("a comment sets nothing and the default is yes") {
        patient.file("/etc/systemd/logind.conf", "[Login]\n#RemoveIPC=no\n");
        is(check_remove_ipc(patient.machine), Verdict::warn, "yes (the default)");
    }
    SECTION("only the section Login counts") {
        patient.file("/etc/systemd/logind.conf", "[Other]\nRemoveIPC=no\n");
        is(check_remove_ipc(patient.machine), Verdict::warn, "yes");
    }
    SECTION("a drop-in overrules the main file") {
        patient.file("/etc/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC = yes\n");
        is(check_remove_ipc(patient.machine), Verdict::warn, "50-ipc.conf");
    }
    SECTION("the later name wins whatever its folder") {
        patient.file("/etc/systemd/logind.conf.d/10-a.conf", "[Login]\nRemoveIPC=yes\n");
        patient.file("/usr/lib/systemd/logind.conf.d/90-b.conf", "[Login]\nRemoveIPC=off\n");
        is(check_remove_ipc(patient.machine), Verdict::ok, "off");
    }
    SECTION("a file hides those of its name in later folders") {
        patient.file("/etc/systemd/logind.conf.d/50-ipc.conf", "");
        patient.file("/usr/lib/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(patient.machine), Verdict::ok, "no");
    }
    SECTION("system users are exempt") {
        patient.file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(patient.machine), Verdict::warn, "yes");
        patient.machine.answers.user = 120;
        is(check_remove_ipc(patient.machine), Verdict::ok, "system user");
    }
    SECTION("where systemd does not run nobody reads it") {
        patient.file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        std::filesystem::remove_all(patient.machine.path("/run/systemd"));
        is(check_remove_ipc(patient.machine), Verdict::ok, "does not run");
    }
}

TEST_CASE("what is not permitted is a warning with its reason") {
    Patient patient;
    auto& answers = patient.machine.answers;
    is(check_locking(patient.machine), Verdict::ok, "permitted");
    is(check_fifo(patient.machine), Verdict::ok, "permitted");
    answers.lock_error = ENOMEM;
    answers.fifo_error = EPERM;
    is(check_locking(patient.machine), Verdict::warn, "refused (Cannot allocate memory)");
    is(check_fifo(patient.machine), Verdict::warn, "refused (Operation not permitted)");
}

TEST_CASE("a low limit counts only for those whom it binds") {
    Patient patient;
    auto& answers = patient.machine.answers;
    is(check_locked_limit(patient.machine), Verdict::ok, "unlimited");
    is(check_realtime_limit(patient.machine), Verdict::ok, "90");
    answers.locked_limit = 8 << 20;
    answers.realtime_limit = 0;
    is(check_locked_limit(patient.machine), Verdict::ok, "8 MiB, does not bind");
    is(check_realtime_limit(patient.machine), Verdict::ok, "0, does not bind");
    answers.lock_error = answers.fifo_error = EPERM;
    is(check_locked_limit(patient.machine), Verdict::warn, "8 MiB");
    is(check_realtime_limit(patient.machine), Verdict::warn, "0");
}

TEST_CASE("real-time throttling is off or a warning") {
    Patient patient;
    is(check_realtime_throttling(patient.machine), Verdict::ok, "off");
    patient.file("/proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    is(check_realtime_throttling(patient.machine), Verdict::warn, "950000 of each 1000000 us");
    patient.no_file("/proc/sys/kernel/sched_rt_runtime_us");
    is(check_realtime_throttling(patient.machine), Verdict::ok, "not in this kernel");
}

TEST_CASE("a host needs files to open") {
    Patient patient;
    is(check_open_files(patient.machine), Verdict::ok, "1024");
    patient.machine.answers.files_limit = 256;
    is(check_open_files(patient.machine), Verdict::warn, "256");
    patient.machine.answers.files_limit = 20;
    is(check_open_files(patient.machine), Verdict::bad, "20");
    patient.machine.answers.files_limit = unlimited;
    is(check_open_files(patient.machine), Verdict::ok, "unlimited");
}

TEST_CASE("a link needs an inotify instance") {
    Patient patient;
    is(check_inotify(patient.machine), Verdict::ok, "128 instances");
    patient.file("/proc/sys/fs/inotify/max_user_instances", "8\n");
    is(check_inotify(patient.machine), Verdict::warn, "8 instances");
    patient.file("/proc/sys/fs/inotify/max_user_instances", "many\n");
    is(check_inotify(patient.machine), Verdict::warn, "unknown");
    patient.machine.answers.inotify_error = EMFILE;
    is(check_inotify(patient.machine), Verdict::bad, "Too many open files");
}

TEST_CASE("two hosts want two cores and cores of their own") {
    Patient patient;
    is(check_cores(patient.machine), Verdict::ok, "4");
    patient.machine.answers.cores = 1;
    is(check_cores(patient.machine), Verdict::warn, "1");
    is(check_isolation(patient.machine), Verdict::ok, "2-3");
    is(check_nohz_full(patient.machine), Verdict::ok, "2-3");
    patient.file("/sys/devices/system/cpu/isolated", "\n");
    patient.file("/sys/devices/system/cpu/nohz_full", "  (null)\n");
    is(check_isolation(patient.machine), Verdict::warn, "none");
    is(check_nohz_full(patient.machine), Verdict::warn, "none");
}

TEST_CASE("one core with another governor is enough for a warning") {
    Patient patient;
    is(check_governor(patient.machine), Verdict::ok, "performance");
    patient.file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "schedutil\n");
    is(check_governor(patient.machine), Verdict::warn, "performance, schedutil");
    std::filesystem::remove_all(patient.machine.path("/sys/devices/system/cpu"));
    is(check_governor(patient.machine), Verdict::ok, "none");
}

TEST_CASE("low-latency-idle needs its device") {
    Patient patient;
    is(check_dma_latency(patient.machine), Verdict::ok, "writable");
    patient.machine.answers.dma_latency_error = EACCES;
    is(check_dma_latency(patient.machine), Verdict::warn, "not writable (Permission denied)");
    patient.machine.answers.dma_latency_error = ENOENT;
    is(check_dma_latency(patient.machine), Verdict::warn, "not there");
}

TEST_CASE("the preemption mode is found wherever the kernel shows it") {
    Patient patient;
    const auto version = [&](const std::string& text) { patient.file("/proc/sys/kernel/version", text); };
    is(check_preemption(patient.machine), Verdict::ok, "PREEMPT_RT");
    version("#1 SMP PREEMPT Debian\n");
    is(check_preemption(patient.machine), Verdict::ok, "full");
    version("#1 SMP Debian\n");
    is(check_preemption(patient.machine), Verdict::warn, "none or voluntary");
    version("#1 SMP PREEMPT_DYNAMIC Debian\n");
    is(check_preemption(patient.machine), Verdict::warn, "not visible");
    patient.file("/proc/cmdline", "quiet preempt=full root=/dev/sda\n");
    is(check_preemption(patient.machine), Verdict::ok, "full");
    patient.file("/sys/kernel/debug/sched/preempt", "none (voluntary) full\n");
    is(check_preemption(patient.machine), Verdict::warn, "voluntary");
    patient.file("/sys/kernel/realtime", "1\n");
    is(check_preemption(patient.machine), Verdict::ok, "PREEMPT_RT");
}

TEST_CASE("a clock that takes a system call is a warning") {
    Patient patient;
    const auto source = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
    is(check_clock_source(patient.machine), Verdict::ok, "tsc");
    patient.file(source, "hpet\n");
    is(check_clock_source(patient.machine), Verdict::warn, "hpet");
    patient.no_file(source);
    is(check_clock_source(patient.machine), Verdict::warn, "unknown");
}

TEST_CASE("a large timer slack is a warning") {
    Patient patient;
    is(check_timer_slack(patient.machine), Verdict::ok, "50 us");
    patient.machine.answers.timer_slack_ns = 40'000'000;
    is(check_timer_slack(patient.machine), Verdict::warn, "40 ms");
}

TEST_CASE("a guest is told so and of whom") {
    Patient patient;
    is(check_hypervisor(patient.machine), Verdict::ok, "none");
    patient.file("/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu hypervisor tsc\nbugs\t: x\n");
    is(check_hypervisor(patient.machine), Verdict::warn, "yes");
    patient.file("/sys/class/dmi/id/sys_vendor", "QEMU\n");
    patient.file("/sys/class/dmi/id/product_name", "Standard PC\n");
    is(check_hypervisor(patient.machine), Verdict::warn, "QEMU Standard PC");
}

TEST_CASE("this machine answers every question") {
    const Machine machine = this_machine();
    CHECK(machine.answers.cores >= 1);
    CHECK(machine.answers.shm_bytes > 0);
    CHECK(machine.answers.user == geteuid());
    CHECK(examine(machine).size() == 20);
}
