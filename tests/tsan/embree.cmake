# Embree builds and compares its trees in the thread that asks for it. It is not instrumented: what its tasks hand from one
# thread to another would be taken for races, and to suppress those would be to suppress ours.
add_library(automorph_embree_in_one_thread STATIC ${CMAKE_CURRENT_LIST_DIR}/embree_in_one_thread.cpp)
target_link_libraries(automorph_embree_in_one_thread PRIVATE embree TBB::tbb)
target_link_options(automorph_flags INTERFACE -Wl,--wrap=rtcCommitScene,--wrap=rtcCollide)
target_link_libraries(automorph_flags INTERFACE automorph_embree_in_one_thread)
