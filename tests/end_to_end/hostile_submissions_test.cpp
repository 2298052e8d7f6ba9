// Programs that mean harm, each a submission of one class: every one ends in time with its verdict, none sees
// or reaches what is not its own, and the right one among them stays right. As whoever runs the tests, and
// where that is root, as a user, too.
#include <nlohmann/json.hpp>

#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Prints REACHED where it got what it may not have. "|" separates the verdicts that are right.
struct Hostile {
  const char* name;
  const char* verdicts;
  const char* text;
};

constexpr const char* shell = "#!/bin/sh\n";
constexpr const char* python =
    "#!/usr/bin/python3\n"
    "import ctypes, glob, mmap, os, signal, socket, sys, threading, time\n"
    "libc = ctypes.CDLL(None, use_errno=True)\n"
    "picture = sys.argv[2]\n";

constexpr Hostile shells[] = {
    {"fork-bomb", "too-many-processes", "b() { b | b & }; b; wait; sleep 100"},
    {"many-processes", "too-many-processes",
     "i=0; while [ $i -lt 150 ]; do i=$((i+1)); sleep 100 & done; wait"},
    {"flood", "too-much-output", "exec cat /dev/zero"},
    {"loop", "timed-out|too-much-cpu", "while :; do :; done"},
    {"sleep", "timed-out", "sleep 1000"},
    {"deaf", "timed-out", "trap '' TERM INT HUP QUIT; while :; do sleep 1; done"},
    {"daemon", "no-image", "(setsid sh -c 'sleep 987654' > /dev/null 2>&1 &) ; exit 0"},
    {"large-picture", "too-much-output", "cat /dev/zero > \"$2\""},
    {"full-disk", "too-much-output", "cat /dev/zero > /tmp/x; sleep 100"},
    {"full-shared-memory", "too-much-output", "cat /dev/zero > /dev/shm/x; sleep 100"},
    {"unlinked", "too-much-output", "exec 9> x; rm x; cat /dev/zero >&9; sleep 100"},
    {"sparse", "too-much-output", "truncate -s 1T \"$2\""},
    {"link", "no-image", "ln -s ../right/s.ppm \"$2\"; ln -s /etc/passwd out.ppm"},
    {"pipe", "no-image", "mkfifo \"$2\""},
    {"device", "crashed|no-image", "mknod \"$2\" c 1 5"},
    {"directory", "no-image", "mkdir \"$2\""},
    {"locked", "right", "cp \"$0.ppm\" \"$2\"; chmod 0 . ; cd /; chmod 0 /tmp/judged /tmp"},
    {"closed", "right", "cp \"$0.ppm\" \"$2\"; exec <&- >&- 2>&-; exec 3>&- 4>&- 5>&-; true"},
    {"reader", "no-image",
     "here=$(dirname \"$0\"); cat \"$here/../right/run.ppm\" && echo REACHED\n"
     "cat \"$here/../../secret\" && echo REACHED\n"
     "[ \"$(ls \"$here/..\")\" = reader ] || echo REACHED the class\n"
     "ls -A /home/* /root/* /var /run 2> /dev/null && echo REACHED; true"},
    {"writer", "no-image",
     "for d in / /etc /usr /usr/bin /bin /dev /proc /sys \"$(dirname \"$0\")\"; do\n"
     "touch $d/owned && echo REACHED $d; done; echo >> \"$0\" && echo REACHED itself; true"},
    {"network", "no-image", "grep -v lo: /proc/net/dev | grep : && echo REACHED; true"},
    {"killer", "no-image|crashed", "kill -9 1; kill -9 $PPID; kill -9 -1; true"},
    {"privileges", "no-image",
     "grep -q 'NoNewPrivs:.1' /proc/self/status || echo REACHED; mount -t tmpfs x /tmp && echo REACHED\n"
     "grep 'Cap[PE][a-z]*:' /proc/self/status | grep -v 0000000000000000 && echo REACHED; true"},
};

constexpr Hostile pythons[] = {
    {"threads", "too-many-processes",
     "for i in range(2000): threading.Thread(target=time.sleep, args=(100,)).start()"},
    {"memory", "too-much-memory", "all = []\nwhile True: all.append(b'x' * (1 << 22))"},
    {"shared-memory", "too-much-memory",
     "all = []\nfor i in range(200):\n all.append(mmap.mmap(-1, 1 << 20)); all[-1].write(b'x' * (1 << 20))\n"
     " all[-1].madvise(mmap.MADV_DONTNEED)\ntime.sleep(100)"},
    {"shared-by-children", "too-much-memory",
     "m = mmap.mmap(-1, 200 << 20)\nfor i in range(200):\n"
     " if os.fork() == 0: m[i << 20:(i + 1) << 20] = b'x' * (1 << 20); os._exit(0)\n os.wait()\n"
     "time.sleep(100)"},
    {"memory-files", "too-much-memory|crashed",
     "all = []\nwhile True: all.append(os.memfd_create('x')); os.write(all[-1], b'x' * (4 << 20))"},
    {"system-v-memory", "too-much-memory|crashed",
     "while True:\n i = libc.shmget(0, ctypes.c_size_t(1 << 20), 0o1600)\n"
     " if i < 0: sys.exit(3)\n libc.shmat.restype = ctypes.c_void_p\n"
     " ctypes.memset(libc.shmat(i, None, 0), 1, 1 << 20)"},
    {"deep", "too-much-output", "for i in range(100000):\n os.mkdir('d')\n os.chdir('d')\ntime.sleep(100)"},
    {"many-files", "too-much-output",
     "for i in range(100000): open('f%d' % i, 'w').close()\ntime.sleep(100)"},
    {"long-names", "no-image|too-much-output",
     "for c in 'abc\\n\\x01': open(c * 255, 'w').close()\ntry: open('x' * 256, 'w')\nexcept OSError: pass"},
    {"double-fork", "no-image",
     "if os.fork() == 0:\n os.setsid()\n if os.fork() == 0:\n  time.sleep(987654)\n os._exit(0)"},
    {"lost-children", "too-much-cpu|timed-out",
     "signal.signal(signal.SIGCHLD, signal.SIG_IGN)\nwhile True:\n"
     " if os.fork() == 0:\n  end = time.process_time() + 0.3\n  while time.process_time() < end: pass\n"
     "  os._exit(0)\n time.sleep(0.3)"},
    {"internet", "no-image",
     "try:\n socket.create_connection(('1.1.1.1', 53), 1); print('REACHED')\nexcept OSError: pass"},
    {"calls", "no-image",
     "def reached(name, *numbers):\n"
     " if libc.syscall(*[ctypes.c_long(n) for n in numbers]) >= 0: print('REACHED', name)\n"
     "nr = {'x86_64': dict(ptrace=101, unshare=272, clone=56, keyctl=250, add_key=248, bpf=321, uffd=323,"
     " perf=298, uring=425, setns=308, mount=165, kexec=246, personality=135),"
     " 'aarch64': dict(ptrace=117, unshare=97, clone=220, keyctl=219, add_key=217, bpf=280, uffd=282,"
     " perf=241, uring=425, setns=268, mount=40, kexec=104, personality=92)}[os.uname().machine]\n"
     "for name in ('ptrace', 'keyctl', 'bpf', 'uffd', 'mount', 'kexec'): reached(name, nr[name], 0, 0, 0, "
     "0)\n"
     "reached('userns', nr['unshare'], 0x10000000)\nreached('clone', nr['clone'], 0x10000011, 0, 0, 0, 0)\n"
     "reached('clone3', 435, 0, 0)\nreached('uring', nr['uring'], 8, 0)\nreached('setns', nr['setns'], 0, "
     "0)\n"
     "reached('personality', nr['personality'], 0x40000)"},
    {"proc", "no-image",
     "for f in ('/proc/1/root/etc/shadow', '/proc/1/root/root', '/proc/1/cwd/root'):\n"
     " try:\n  (os.listdir if f.endswith('root') else open)(f); print('REACHED', f)\n"
     " except OSError: pass\n"
     "files = ['/proc/sys/kernel/core_pattern', '/proc/sysrq-trigger']\n"
     // The first process may be the program's own user's: then it can do no more than the program.
     "if os.stat('/proc/1/mem').st_uid != os.getuid(): files += ['/proc/1/mem', '/proc/1/oom_score_adj']\n"
     "for f in files:\n"
     " try: open(f, 'r+b'); print('REACHED', f)\n except OSError: pass\n"
     "def rights(p): return [l for l in open('/proc/%s/status' % p) if l[:4] in ('CapP', 'CapE', 'NoNe', "
     "'Secc')]\n"
     "if rights(1) != rights('self'): print('REACHED', rights(1), rights('self'))\n"
     "if len([p for p in os.listdir('/proc') if p.isdigit()]) > 8: print('REACHED others')"},
    {"plumb", "no-image",
     "plumb = '@plumb@'\nfor f in [plumb, os.path.dirname(plumb)] + glob.glob('/usr/*bin/plumb*'):\n"
     " if os.access(f, os.X_OK) and os.path.isfile(f): print('REACHED', f)\n"
     "for f in ('@source@/references/images', '@source@/tests/scenes'):\n"
     " if os.path.exists(f): print('REACHED', f)\n"
     "try: os.execv(plumb, [plumb, 'render', sys.argv[1], '-o', picture])\nexcept OSError: pass"},
    {"setuid", "no-image",
     "for f in ('/bin/su', '/usr/bin/passwd', '/usr/bin/sudo', '/bin/mount'):\n"
     " if os.path.exists(f): os.system(f + ' --help > /dev/null 2>&1')\n"
     "for call in (libc.setuid, libc.setgid): \n if os.getuid() and call(0) == 0: print('REACHED')"},
    {"messages", "no-image",
     "a, b = socket.socketpair()\ntry:\n"
     " while True: a.send(b'x' * 4096, socket.MSG_DONTWAIT)\nexcept OSError: pass"},
};

/// Where somebody has to wait for the end of a run it lasts no longer than needed; all others have as much
/// time as a busy machine takes.
bool is_waited_for(const Hostile& hostile) { return contains(hostile.verdicts, "timed-out"); }

class HostileSubmissions : public testing::Test {
 protected:
  void SetUp() override {
    submissions::require_sandbox();
    fs::create_directories(workplace_.path("scenes"));
    workplace_.file("scenes/s.sdf", std::string(ball_scene));
    workplace_.file("secret", "the secret");
    ASSERT_EQ(run_plumb({"render", "scenes/s.sdf", "-o", "right.ppm"}, workplace_.directory()).exit_code, 0);
    for (const char* const of_class : {"class", "waiting"})
      hand_in(of_class, {"right", "right", "cp \"$0.ppm\" \"$2\""}, shell);
    for (const Hostile& hostile : shells)
      hand_in(is_waited_for(hostile) ? "waiting" : "class", hostile, shell);
    for (const Hostile& hostile : pythons)
      hand_in(is_waited_for(hostile) ? "waiting" : "class", hostile, python);
    fs::permissions(workplace_.directory(), fs::perms(0755));
  }

  /// A directory with the program `run`, and the right picture beside it for who copies it.
  void hand_in(const std::string& of_class, const Hostile& hostile, const std::string& head) {
    const std::string place = of_class + "/" + hostile.name;
    fs::create_directories(workplace_.path(place));
    fs::permissions(workplace_.file(place + "/run", head + with_paths(hostile.text) + "\n"), fs::perms(0755));
    if (contains(hostile.text, "$0.ppm"))
      fs::copy_file(workplace_.path("right.ppm"), workplace_.path(place + "/run.ppm"));
    expected_[of_class][hostile.name] = hostile.verdicts;
  }

  static std::string with_paths(std::string text) {
    for (const auto& [name, path] :
         {std::pair("@plumb@", std::string(PLUMB_BINARY)), std::pair("@source@", source_path(""))})
      while (contains(text, name)) text = replaced(text, name, path);
    return text;
  }

  void judge_both(const std::string& as_who) const {
    const auto before = listing(workplace_.directory());
    judge(as_who, "class", "60");
    judge(as_who, "waiting", "3");
    EXPECT_EQ(listing(workplace_.directory()), before);
    EXPECT_TRUE(contains(run_shell("pgrep -f 'sleep.98765[4]' || echo none", "/").output, "none"));
  }

  void judge(const std::string& as_who, const std::string& of_class, const std::string& seconds) const {
    system::ProcessLimits limits;
    limits.memory_bytes = std::numeric_limits<std::size_t>::max();  // an address sanitizer reserves terabytes
    const std::string command = as_who + " \"$0\" judge --renderer '{submission}/run {scene} {image}'" +
                                " --scenes scenes --submissions " + of_class + " --timeout " + seconds +
                                " --memory 64 --disk 16 --json - 2> /dev/null";
    const auto result =
        system::run_process({"/bin/sh", "-c", command, PLUMB_BINARY}, workplace_.directory(), limits);
    const Json all = Json::parse(result.output, nullptr, false);
    ASSERT_TRUE(all.is_object()) << result.output;
    EXPECT_EQ(all["pictures"].size(), expected_.at(of_class).size());
    for (const Json& picture : all["pictures"])
      check(picture, expected_.at(of_class).at(picture["submission"].get<std::string>()));
  }

  static void check(const Json& picture, const std::string& expected) {
    const std::string verdict = picture["verdict"];
    EXPECT_TRUE(contains("|" + expected + "|", "|" + verdict + "|")) << expected << ": " << picture;
    EXPECT_FALSE(contains(picture.value("printed", ""), "REACHED")) << picture;
  }

  Workplace workplace_;
  std::map<std::string, std::map<std::string, std::string>> expected_;
};

TEST_F(HostileSubmissions, EndInTimeAndReachNothing) { judge_both(""); }

TEST_F(HostileSubmissions, NorAsAUser) {
  if (geteuid() != 0) GTEST_SKIP() << "the test above ran as a user";
  fs::permissions(workplace_.directory(), fs::perms(0777));
  judge_both("setpriv --reuid 54321 --regid 54321 --clear-groups");
}

/// A user's processes are counted together, but those of a sandbox are not among them.
TEST_F(HostileSubmissions, AForkBombTakesNothingFromOthers) {
  hand_in("bombed", {"b-bomb", "too-many-processes", ""}, shell);
  const auto compiled = run_shell(
      "echo 'extern \"C\" int fork(); int main() { for (;;) fork(); }' | c++ -x c++ -o bombed/b-bomb/run -",
      workplace_.directory());
  ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
  for (const char* const name : {"a", "c", "d", "e", "f"})
    hand_in("bombed", {name, "right", "cp \"$0.ppm\" \"$2\""}, shell);
  fs::permissions(workplace_.directory(), fs::perms(0777));
  judge(geteuid() == 0 ? "setpriv --reuid 54321 --regid 54321 --clear-groups" : "", "bombed", "60");
}

}  // namespace
}  // namespace plumb::tests
