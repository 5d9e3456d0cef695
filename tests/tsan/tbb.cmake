# TBB::tbb, built with the thread sanitizer in it: what orders our tasks happens in that library, and a sanitizer that
# does not see it takes each of them for a race. Embree then uses this one, too.
include(FetchContent)
FetchContent_Declare(oneTBB DOWNLOAD_COMMAND ${CMAKE_CURRENT_LIST_DIR}/fetch_tbb.sh <SOURCE_DIR> SYSTEM)
set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # these variables stand for the options of that project
set(TBB_SANITIZE thread)
set(TBB_TEST OFF)
set(TBB_STRICT OFF)
set(TBBMALLOC_BUILD OFF)
set(TBB_DISABLE_HWLOC_AUTOMATIC_SEARCH ON)
unset(TBB_DIR CACHE)  # which the last line sets: that project would take it for a TBB to be tested
FetchContent_MakeAvailable(oneTBB)
file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/tbb-config.cmake "")  # others that look for TBB have it now
set_target_properties(tbb PROPERTIES UNITY_BUILD OFF)
target_compile_options(tbb PRIVATE -w)  # not ours
