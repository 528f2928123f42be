// SPDX-License-Identifier: Apache-2.0
// The parts of coil that components of 1.x and 2.x use.
#include "tests/support/comma_locale.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>
#include <coil/Affinity.h>
#include <coil/Async.h>
#include <coil/ClockManager.h>
#include <coil/Condition.h>
#include <coil/DynamicLib.h>
#include <coil/File.h>
#include <coil/Guard.h>
#include <coil/Mutex.h>
#include <coil/OS.h>
#include <coil/PeriodicTask.h>
#include <coil/Process.h>
#include <coil/SharedMemory.h>
#include <coil/Time.h>
#include <coil/Timer.h>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/mman.h>

TEST_CASE("A coil TimeValue keeps seconds and microseconds of one sign") {
    const coil::TimeValue none;
    CHECK(none.sec() == 0);
    CHECK(none.usec() == 0);
    const coil::TimeValue a(1, 1500000);
    CHECK(a.sec() == 2);
    CHECK(a.usec() == 500000);
    const coil::TimeValue back = coil::TimeValue(1, 200000) - coil::TimeValue(1, 500000);
    CHECK(back.sec() == 0);
    CHECK(back.usec() == -300000);
    CHECK(back.sign() == -1);
    const coil::TimeValue mixed(2, -300000);
    CHECK(mixed.sec() == 1);
    CHECK(mixed.usec() == 700000);
    CHECK(coil::TimeValue(-2, 300000).sec() == -1);
    CHECK(coil::TimeValue(-2, 300000).usec() == -700000);
}

TEST_CASE("A coil TimeValue is made from numbers and converts to seconds as a double") {
    coil::TimeValue t = 0.25; // not an integer's 0
    CHECK(t.usec() == 250000);
    t = -1.75;
    CHECK(t.sec() == -1);
    CHECK(t.usec() == -750000);
    const coil::TimeValue three = 3;
    CHECK(three.sec() == 3);
    CHECK(coil::TimeValue(std::chrono::milliseconds(1500)).usec() == 500000);
    const double sum = three + coil::TimeValue(0, 500000);
    CHECK(sum == Approx(3.5));
    CHECK(three - 0.5 == Approx(2.5));
    CHECK(three > 2.5);
    CHECK(three * 2 == Approx(6));
}

namespace {

/// A type of a component, with a separate operator>>.
struct Range {
    double from = 0, to = 0;
};
std::istream& operator>>(std::istream& in, Range& range) {
    char dash = 0;
    return in >> range.from >> dash >> range.to;
}

} // namespace

TEST_CASE("Numbers have a decimal point and nothing between thousands, whatever locale a component has set") {
    const tandem::test::CommaLocale locale;
    double number = 0;
    CHECK(coil::stringTo(number, "0.5"));
    CHECK(number == 0.5);
    std::vector<double> numbers;
    CHECK(coil::stringTo(numbers, "0.25, 1000.5"));
    CHECK(numbers == std::vector<double>{0.25, 1000.5});
    std::chrono::milliseconds time{0};
    CHECK(coil::stringTo(time, "1.5"));
    CHECK(time.count() == 1500);
    Range range;
    CHECK(coil::stringTo(range, "0.5-2.5"));
    CHECK((range.from == 0.5 && range.to == 2.5));
    CHECK(coil::otos(1234.5) == "1234.5");
    CHECK(coil::otos(1234567) == "1234567");
    CHECK(coil::sprintf("%.1f", 1234.5) == "1234.5");
    void* pointer = nullptr;
    CHECK(coil::hexToPtr(pointer, coil::ptrToHex(&number)));
    CHECK(pointer == &number);
    CHECK(coil::ptrToHex(&number).find('.') == std::string::npos);
}

TEST_CASE("The coil clock runs and usleep waits at least its time") {
    const coil::TimeValue begin = coil::gettimeofday();
    const auto before = std::chrono::steady_clock::now();
    CHECK(coil::usleep(2000) == 0);
    CHECK(coil::sleep(coil::TimeValue(0, 1000)) == 0);
    CHECK(std::chrono::steady_clock::now() - before >= std::chrono::microseconds(3000));
    CHECK(begin.sec() > 1600000000);
    timeval now{};
    CHECK(coil::gettimeofday(&now) == 0);
    CHECK(now.tv_sec >= begin.sec());
}

TEST_CASE("trylock of a coil Mutex is false when it has got the lock and try_lock is true") {
    coil::Mutex mutex;
    CHECK_FALSE(mutex.trylock());
    CHECK(mutex.trylock());
    CHECK_FALSE(mutex.try_lock());
    mutex.unlock();
    {
        coil::Guard<coil::Mutex> guard(mutex);
        CHECK_FALSE(mutex.try_lock());
    }
    CHECK(mutex.try_lock());
    mutex.unlock();
}

TEST_CASE("A coil Condition wakes its waiters, and a wait ends at its timeout") {
    coil::Mutex mutex;
    coil::Condition<coil::Mutex> condition(mutex);
    bool notified = false;
    std::thread signaller;
    {
        coil::Guard<coil::Mutex> guard(mutex);
        CHECK_FALSE(condition.wait(0, 1000000));
        signaller = std::thread([&] {
            coil::Guard<coil::Mutex> inner(mutex);
            notified = true;
            condition.signal();
        });
        for (int i = 0; i < 1000 && !notified; ++i) condition.wait(0, 10000000);
    }
    signaller.join();
    CHECK(notified);
}

namespace {

struct Work : coil::Task {
    int svc() override {
        ++runs;
        return 0;
    }
    void finalize() override { ++ends; }
    std::atomic<int> runs{0}, ends{0};
};

} // namespace

TEST_CASE("A coil Task runs svc and then finalize and can be activated again") {
    Work work;
    work.activate();
    work.wait();
    CHECK(work.runs == 1);
    CHECK(work.ends == 1);
    work.activate();
    work.wait();
    CHECK(work.runs == 2);
}

namespace {

struct Ticks {
    int tick() {
        ++count;
        return 0;
    }
    bool reach(int wanted) const {
        for (int i = 0; i < 10000 && count < wanted; ++i) coil::usleep(1000);
        return count >= wanted;
    }
    std::atomic<int> count{0};
};

} // namespace

TEST_CASE("A coil PeriodicTask calls its function until finalize") {
    Ticks ticks;
    coil::PeriodicTask task;
    REQUIRE(task.setTask(&ticks, &Ticks::tick)); // the form of 1.x
    task.setPeriod(0.001);
    task.activate();
    CHECK(ticks.reach(5));
    task.finalize();
    task.wait();
    const int at_the_end = ticks.count;
    coil::usleep(5000);
    CHECK(ticks.count == at_the_end);
}

TEST_CASE("A suspended coil PeriodicTask makes one call for each signal") {
    Ticks ticks;
    coil::PeriodicTask task;
    task.setTask([&] { ticks.tick(); });
    task.setPeriod(std::chrono::microseconds(100));
    task.suspend();
    task.activate();
    coil::usleep(5000);
    CHECK(ticks.count == 0);
    task.signal();
    task.signal();
    CHECK(ticks.reach(2));
    coil::usleep(5000);
    CHECK(ticks.count == 2);
    task.resume();
    CHECK(ticks.reach(10));
}

TEST_CASE("An asynchronous coil call runs once") {
    std::atomic<int> calls{0};
    auto* call = coil::AsyncInvoker(&calls, [](std::atomic<int>* n) { ++*n; });
    call->invoke();
    call->wait();
    CHECK(call->finished());
    CHECK(calls == 1);
    call->exit();
}

TEST_CASE("A coil Timer calls delayed functions once and periodic ones until they are stopped") {
    using std::chrono::milliseconds;
    int once = 0, often = 0;
    coil::Timer<coil::DelayedFunction> delayed;
    delayed.emplace([&] { ++once; }, milliseconds(15));
    coil::Timer<std::shared_ptr<coil::PeriodicFunction>> periodic;
    auto function = std::make_shared<coil::PeriodicFunction>([&] { ++often; }, milliseconds(10));
    periodic.emplace(function);
    for (int i = 0; i < 4; ++i) {
        delayed.tick(milliseconds(10));
        periodic.tick(milliseconds(10));
    }
    CHECK(once == 1);
    CHECK(often == 4);
    function->stop();
    periodic.tick(milliseconds(10));
    CHECK(often == 4);
}

TEST_CASE("The logical coil clock stands still and the adjusted one runs on") {
    auto& clocks = coil::ClockManager::instance();
    auto& logical = clocks.getClock("logical");
    REQUIRE(logical.settime(std::chrono::seconds(5)));
    CHECK(logical.gettime() == std::chrono::seconds(5));
    auto& adjusted = clocks.getClock("adjusted");
    REQUIRE(adjusted.settime(std::chrono::seconds(100)));
    CHECK(adjusted.gettime() >= std::chrono::seconds(100));
    CHECK_FALSE(clocks.getClock("").settime(std::chrono::seconds(0)));
    CHECK(clocks.getClock("").gettime() > std::chrono::hours(24 * 365 * 50));
}

TEST_CASE("coil shared memory is visible to every process that opens it, and is bounded") {
    const std::string name = "/tandem_coil_test_" + std::to_string(coil::getpid());
    char text[5] = "";
    {
        coil::SharedMemory maker, user;
        REQUIRE(maker.create(name, 4096) == 0);
        CHECK(user.open(name, 8192) == -1); // more than there is
        REQUIRE(user.open(name, 4096) == 0);
        CHECK(maker.write("abcd", 4092, 4) == 0);
        CHECK(maker.write("abcd", 4093, 4) == -1);
        CHECK(user.read(text, 4092, 4) == 0);
        CHECK(user.read(text, 4096, 1) == -1);
        CHECK(user.get_size() == 4096);
    }
    CHECK(std::string(text) == "abcd");
    CHECK(::shm_open(name.c_str(), O_RDONLY, 0) == -1); // gone with its maker
}

TEST_CASE("coil shared memory of another user is refused") {
    if (geteuid() != 0) TANDEM_SKIP("only root can create what belongs to another user");
    const std::string name = "/tandem_coil_test_" + std::to_string(coil::getpid());
    const int object = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, 0666);
    REQUIRE(::ftruncate(object, 4096) == 0);
    REQUIRE(::fchown(object, 65534, 65534) == 0);
    coil::SharedMemory memory;
    CHECK(memory.open(name, 4096) == -1);
    CHECK(memory.create(name, 4096) == -1);
    ::close(object);
    ::shm_unlink(name.c_str());
}

TEST_CASE("coil finds files by name and by extension") {
    namespace fs = std::filesystem;
    const fs::path dir = fs::temp_directory_path() / ("tandem_coil_" + std::to_string(coil::getpid()));
    fs::create_directories(dir / "sub");
    for (const char* name : {"a.conf", "b.txt", "sub/a.conf"}) std::ofstream(dir / name) << "x";
    CHECK(coil::filelist(dir.c_str(), "*.conf") == coil::vstring{"a.conf"});
    CHECK(coil::filelist(dir.c_str()).size() == 3);
    coil::vstring by_name, by_extension;
    coil::findFile(dir, "a.conf", by_name);
    coil::getFileList(dir, "txt", by_extension);
    CHECK(by_name.size() == 2);
    CHECK(by_extension == coil::vstring{dir / "b.txt"});
    CHECK(coil::filelist("/no/such/folder").empty());
    CHECK(coil::dirname("/a/b/c.txt") == "/a/b");
    CHECK(coil::basename("/a/b/c.txt") == "c.txt");
    CHECK(coil::dirname("c.txt") == ".");
    fs::remove_all(dir);
}

TEST_CASE("coil opens libraries, or reports why it cannot") {
    coil::DynamicLib library;
    CHECK(library.symbol("cos") == nullptr);
    REQUIRE(library.open("libm.so.6") == 0);
    CHECK(library.symbol("cos") != nullptr);
    const coil::DynamicLib copy(library);
    CHECK(library.close() == 0);
    CHECK(library.close() == -1);
    CHECK(coil::DynamicLib("libm.so.6").symbol("cos") != nullptr);
    CHECK(library.open("libno-such.so") == -1);
    CHECK(std::string(coil::DynamicLib::error()).find("libno-such.so") != std::string::npos);
}

TEST_CASE("coil runs commands and reads options") {
    std::vector<std::string> lines;
    CHECK(coil::create_process("printf 'a b\\nc\\n'", lines) == 0);
    CHECK(lines == std::vector<std::string>{"a b", "c"});
    CHECK(coil::launch_shell("/no/such/program") == -1);
    coil::Argv argv({"test", "-f", "x.conf", "-d", "rest"});
    coil::GetOpt options(static_cast<int>(argv.size()), argv.get(), "f:d", 0);
    CHECK(options() == 'f');
    CHECK(std::string(options.optarg) == "x.conf");
    CHECK(options() == 'd');
    CHECK(options() == -1);
    CHECK(options.optind == 4);
}

TEST_CASE("coil binds a thread to processors it may use") {
    coil::CpuMask all, bound;
    REQUIRE(coil::getThreadCpuAffinity(all));
    REQUIRE_FALSE(all.empty());
    CHECK(coil::setThreadCpuAffinity(coil::CpuMask{all.front()}));
    CHECK(coil::getThreadCpuAffinity(bound));
    CHECK(bound == coil::CpuMask{all.front()});
    CHECK(coil::setThreadCpuAffinity(all));
    CHECK_FALSE(coil::setThreadCpuAffinity(std::string("nothing")));
}
