/// \file
/// --max-seconds and --max-memory: what a picture may cost, and what is said when it costs more.
#pragma once

#include <string>

#include <vtm/limits/limits.hpp>

namespace vtm::tools {

/// They hold for the whole run; 0 for no limit. Without them 60 s and 4096 MB.
void setMaxSeconds(double seconds);
void setMaxMegabytes(double megabytes);

/// Holds the limits on this thread for one picture. A picture that is `alone` ends the process if it cannot
/// be stopped otherwise or takes long to be given up; one of many only in the first case, and memory goes
/// back to the system after it.
class PictureLimits {
public:
    PictureLimits(std::string path, bool alone);
    ~PictureLimits();
    PictureLimits(const PictureLimits&) = delete;
    PictureLimits& operator=(const PictureLimits&) = delete;

private:
    limits::Budget budget_;
    const limits::Scope scope_;
    const bool alone_;
};

/// Seconds after which a simpler way of drawing is tried: a third of --max-seconds, less what is used up; 0
/// for never.
double secondsForFirstTry();

/// `a.svg:3:5: --max-seconds 4: exceeded while stroking <path>`
std::string describe(const std::string& path, const limits::Exceeded& exceeded);

}  // namespace vtm::tools
