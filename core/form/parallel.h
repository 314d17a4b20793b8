#pragma once

#include <functional>

namespace rhombloom {

//! \brief Threads to use when the caller has not said: the machine's, at most 8.
int default_threads();

//! \brief Call task(0) ... task(count - 1), each once, on up to \p threads threads; returns when all are done.
//! \details Tasks must write to different places. Which thread takes a task is left to chance, so a task's result may
//! not depend on it. An exception in a task ends that thread's work and is thrown again here.
void parallel_tasks(int threads, int count, const std::function<void(int)>& task);

} // namespace rhombloom
