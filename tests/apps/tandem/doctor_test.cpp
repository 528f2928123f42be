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

TEST_CASE_METHOD(Patient, "a machine on which all is well gets nothing but ok") {
    const auto findings = examine(machine);
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

TEST_CASE_METHOD(Patient, "a machine without any of the files is examined all the same") {
    std::filesystem::remove_all(machine.root);
    CHECK(examine(machine).size() == 20);
}

TEST_CASE_METHOD(Patient, "/dev/shm must be a tmpfs that can be written") {
    is(check_shm_mount(machine), Verdict::ok, "tmpfs");
    mount("ext4", "rw");
    is(check_shm_mount(machine), Verdict::bad, "ext4");
    mount("tmpfs", "ro,relatime");
    is(check_shm_mount(machine), Verdict::bad, "read-only");
    no_file("/proc/self/mounts");
    is(check_shm_mount(machine), Verdict::bad, "nothing is mounted");
}

TEST_CASE_METHOD(Patient, "/dev/shm must have room for a link and should have room for images") {
    is(check_shm_space(machine), Verdict::ok, "1 GiB free");
    machine.answers.shm_free = std::uint64_t{64} << 20;
    is(check_shm_space(machine), Verdict::warn, "64 MiB free of 1 GiB");
    machine.answers.shm_free = std::uint64_t{1} << 20;
    is(check_shm_space(machine), Verdict::bad, "1 MiB free");
}

TEST_CASE_METHOD(Patient, "huge pages depend on the mount unless the kernel forces or denies them") {
    const auto shmem = "/sys/kernel/mm/transparent_hugepage/shmem_enabled";
    is(check_huge_pages(machine), Verdict::ok, "huge=within_size");
    mount("tmpfs", "rw");
    is(check_huge_pages(machine), Verdict::warn, "huge=never");
    mount("tmpfs", "rw,huge=advise");
    is(check_huge_pages(machine), Verdict::warn, "huge=advise");
    file(shmem, "always within_size advise never deny [force]\n");
    is(check_huge_pages(machine), Verdict::ok, "forced");
    mount("tmpfs", "rw,huge=always");
    file(shmem, "always within_size advise never [deny] force\n");
    is(check_huge_pages(machine), Verdict::warn, "denied");
    no_file(shmem);
    is(check_huge_pages(machine), Verdict::warn, "not in this kernel");
}

TEST_CASE_METHOD(Patient, "RemoveIPC is read as logind reads it") {
    is(check_remove_ipc(machine), Verdict::ok, "no (/etc/systemd/logind.conf)");
    SECTION("a comment sets nothing and the default is yes") {
        file("/etc/systemd/logind.conf", "[Login]\n#RemoveIPC=no\n");
        is(check_remove_ipc(machine), Verdict::warn, "yes (the default)");
    }
    SECTION("only the section Login counts") {
        file("/etc/systemd/logind.conf", "[Other]\nRemoveIPC=no\n");
        is(check_remove_ipc(machine), Verdict::warn, "yes");
    }
    SECTION("a drop-in overrules the main file") {
        file("/etc/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC = yes\n");
        is(check_remove_ipc(machine), Verdict::warn, "50-ipc.conf");
    }
    SECTION("the later name wins whatever its folder") {
        file("/etc/systemd/logind.conf.d/10-a.conf", "[Login]\nRemoveIPC=yes\n");
        file("/usr/lib/systemd/logind.conf.d/90-b.conf", "[Login]\nRemoveIPC=off\n");
        is(check_remove_ipc(machine), Verdict::ok, "off");
    }
    SECTION("a file hides those of its name in later folders") {
        file("/etc/systemd/logind.conf.d/50-ipc.conf", "");
        file("/usr/lib/systemd/logind.conf.d/50-ipc.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(machine), Verdict::ok, "no");
    }
    SECTION("system users are exempt") {
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        is(check_remove_ipc(machine), Verdict::warn, "yes");
        machine.answers.user = 120;
        is(check_remove_ipc(machine), Verdict::ok, "system user");
    }
    SECTION("where systemd does not run nobody reads it") {
        file("/etc/systemd/logind.conf", "[Login]\nRemoveIPC=yes\n");
        std::filesystem::remove_all(machine.path("/run/systemd"));
        is(check_remove_ipc(machine), Verdict::ok, "does not run");
    }
}

TEST_CASE_METHOD(Patient, "what is not permitted is a warning with its reason") {
    is(check_locking(machine), Verdict::ok, "permitted");
    is(check_fifo(machine), Verdict::ok, "permitted");
    machine.answers.lock_error = ENOMEM;
    machine.answers.fifo_error = EPERM;
    is(check_locking(machine), Verdict::warn, "refused (Cannot allocate memory)");
    is(check_fifo(machine), Verdict::warn, "refused (Operation not permitted)");
}

TEST_CASE_METHOD(Patient, "a low limit counts only for those whom it binds") {
    is(check_locked_limit(machine), Verdict::ok, "unlimited");
    is(check_realtime_limit(machine), Verdict::ok, "90");
    machine.answers.locked_limit = 8 << 20;
    machine.answers.realtime_limit = 0;
    is(check_locked_limit(machine), Verdict::ok, "8 MiB, does not bind");
    is(check_realtime_limit(machine), Verdict::ok, "0, does not bind");
    machine.answers.lock_error = machine.answers.fifo_error = EPERM;
    is(check_locked_limit(machine), Verdict::warn, "8 MiB");
    is(check_realtime_limit(machine), Verdict::warn, "0");
}

TEST_CASE_METHOD(Patient, "real-time throttling is off or a warning") {
    is(check_realtime_throttling(machine), Verdict::ok, "off");
    file("/proc/sys/kernel/sched_rt_runtime_us", "950000\n");
    is(check_realtime_throttling(machine), Verdict::warn, "950000 of each 1000000 us");
    no_file("/proc/sys/kernel/sched_rt_runtime_us");
    is(check_realtime_throttling(machine), Verdict::ok, "not in this kernel");
}

TEST_CASE_METHOD(Patient, "a host needs files to open") {
    is(check_open_files(machine), Verdict::ok, "1024");
    machine.answers.files_limit = 256;
    is(check_open_files(machine), Verdict::warn, "256");
    machine.answers.files_limit = 20;
    is(check_open_files(machine), Verdict::bad, "20");
    machine.answers.files_limit = unlimited;
    is(check_open_files(machine), Verdict::ok, "unlimited");
}

TEST_CASE_METHOD(Patient, "a link needs an inotify instance") {
    is(check_inotify(machine), Verdict::ok, "128 instances");
    file("/proc/sys/fs/inotify/max_user_instances", "8\n");
    is(check_inotify(machine), Verdict::warn, "8 instances");
    file("/proc/sys/fs/inotify/max_user_instances", "many\n");
    is(check_inotify(machine), Verdict::warn, "unknown");
    machine.answers.inotify_error = EMFILE;
    is(check_inotify(machine), Verdict::bad, "Too many open files");
}

TEST_CASE_METHOD(Patient, "two hosts want two cores and cores of their own") {
    is(check_cores(machine), Verdict::ok, "4");
    machine.answers.cores = 1;
    is(check_cores(machine), Verdict::warn, "1");
    is(check_isolation(machine), Verdict::ok, "2-3");
    is(check_nohz_full(machine), Verdict::ok, "2-3");
    file("/sys/devices/system/cpu/isolated", "\n");
    file("/sys/devices/system/cpu/nohz_full", "  (null)\n");
    is(check_isolation(machine), Verdict::warn, "none");
    is(check_nohz_full(machine), Verdict::warn, "none");
}

TEST_CASE_METHOD(Patient, "one core with another governor is enough for a warning") {
    is(check_governor(machine), Verdict::ok, "performance");
    file("/sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "schedutil\n");
    is(check_governor(machine), Verdict::warn, "performance, schedutil");
    std::filesystem::remove_all(machine.path("/sys/devices/system/cpu"));
    is(check_governor(machine), Verdict::ok, "none");
}

TEST_CASE_METHOD(Patient, "low-latency-idle needs its device") {
    is(check_dma_latency(machine), Verdict::ok, "writable");
    machine.answers.dma_latency_error = EACCES;
    is(check_dma_latency(machine), Verdict::warn, "not writable (Permission denied)");
    machine.answers.dma_latency_error = ENOENT;
    is(check_dma_latency(machine), Verdict::warn, "not there");
}

TEST_CASE_METHOD(Patient, "the preemption mode is found wherever the kernel shows it") {
    const auto version = [&](const std::string& text) { file("/proc/sys/kernel/version", text); };
    is(check_preemption(machine), Verdict::ok, "PREEMPT_RT");
    version("#1 SMP PREEMPT Debian\n");
    is(check_preemption(machine), Verdict::ok, "full");
    version("#1 SMP Debian\n");
    is(check_preemption(machine), Verdict::warn, "none or voluntary");
    version("#1 SMP PREEMPT_DYNAMIC Debian\n");
    is(check_preemption(machine), Verdict::warn, "not visible");
    file("/proc/cmdline", "quiet preempt=full root=/dev/sda\n");
    is(check_preemption(machine), Verdict::ok, "full");
    file("/sys/kernel/debug/sched/preempt", "none (voluntary) full\n");
    is(check_preemption(machine), Verdict::warn, "voluntary");
    file("/sys/kernel/realtime", "1\n");
    is(check_preemption(machine), Verdict::ok, "PREEMPT_RT");
}

TEST_CASE_METHOD(Patient, "a clock that takes a system call is a warning") {
    const auto source = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
    is(check_clock_source(machine), Verdict::ok, "tsc");
    file(source, "hpet\n");
    is(check_clock_source(machine), Verdict::warn, "hpet");
    no_file(source);
    is(check_clock_source(machine), Verdict::warn, "unknown");
}

TEST_CASE_METHOD(Patient, "a large timer slack is a warning") {
    is(check_timer_slack(machine), Verdict::ok, "50 us");
    machine.answers.timer_slack_ns = 40'000'000;
    is(check_timer_slack(machine), Verdict::warn, "40 ms");
}

TEST_CASE_METHOD(Patient, "a guest is told so and of whom") {
    is(check_hypervisor(machine), Verdict::ok, "none");
    file("/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu hypervisor tsc\nbugs\t: x\n");
    is(check_hypervisor(machine), Verdict::warn, "yes");
    file("/sys/class/dmi/id/sys_vendor", "QEMU\n");
    file("/sys/class/dmi/id/product_name", "Standard PC\n");
    is(check_hypervisor(machine), Verdict::warn, "QEMU Standard PC");
}

TEST_CASE("this machine answers every question") {
    const Machine machine = this_machine();
    CHECK(machine.answers.cores >= 1);
    CHECK(machine.answers.shm_bytes > 0);
    CHECK(machine.answers.user == geteuid());
    CHECK(examine(machine).size() == 20);
}
