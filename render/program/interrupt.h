#pragma once

namespace automorph::program {

/// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is closed) end the process with status
/// 128 + signal (130, 143, 129): at once, or when the file that is being written is whole. One line on stderr
/// says so. A second signal does not wait.
/// Signals that are ignored, as nohup does, stay ignored.
void end_on_signals();

/// What that line says behind "stopped": how to go on. @param advice  must live until the end
void set_stop_advice(const char* advice);

}  // namespace automorph::program
