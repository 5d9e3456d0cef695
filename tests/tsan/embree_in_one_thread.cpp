#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <tbb/global_control.h>

// The linker's --wrap=rtcCommitScene hands us every call of that function, and calls it by the name
// __real_rtcCommitScene.
extern "C" void __real_rtcCommitScene(RTCScene scene);
extern "C" void __real_rtcCollide(RTCScene one, RTCScene other, RTCCollideFunc found, void* user);

namespace {

// No other thread takes a task while this lives. A device with threads=1 would not do: it stays so as long as
// it lives.
struct OneThread {
    tbb::global_control control{tbb::global_control::max_allowed_parallelism, 1};
};

}  // namespace

extern "C" void __wrap_rtcCommitScene(RTCScene scene) {
    const OneThread one_thread;
    __real_rtcCommitScene(scene);
}

extern "C" void __wrap_rtcCollide(RTCScene one, RTCScene other, RTCCollideFunc found, void* user) {
    const OneThread one_thread;
    __real_rtcCollide(one, other, found, user);
}
