#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include <vtm/image/codec.hpp>
#include <vtm/svg/write.hpp>
#include "bench/engines/engine.hpp"

namespace vtm::bench {
namespace {

namespace fs = std::filesystem;

constexpr int patience = 60'000;  ///< milliseconds for an answer

/// A process that answers a line with a line, and a folder for what is too long for one.
class Child {
public:
    explicit Child(std::string command) : command_(std::move(command)) {
        std::signal(SIGPIPE, SIG_IGN);  // a process that died shows in its reply
        start();
        scratch_ = fs::temp_directory_path() / fmt::format("vtm_bench_{}", process_);
        fs::create_directories(scratch_);
    }
    ~Child() {
        stop();
        std::error_code ignored;
        fs::remove_all(scratch_, ignored);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Without its line break; nothing at the end, or where none comes in a minute.
    std::optional<std::string> line() {
        for (std::size_t end; (end = unread_.find('\n')) == std::string::npos;) {
            char text[4096];
            pollfd input{out_, POLLIN, 0};
            const ssize_t count = poll(&input, 1, patience) == 1 ? read(out_, text, sizeof text) : 0;
            if (count <= 0)
                return std::nullopt;
            unread_.append(text, std::size_t(count));
        }
        const std::size_t end = unread_.find('\n');
        const std::string text = unread_.substr(0, end);
        unread_.erase(0, end + 1);
        return text;
    }

    /// What stands after "ok "; std::runtime_error with what stands after "error ". A process that ends says
    /// so once and is started anew.
    std::string ask(const std::string& request) {
        const std::string text = request + "\n";
        const bool sent = write(in_, text.data(), text.size()) == ssize_t(text.size());
        while (const std::optional<std::string> reply = sent ? line() : std::nullopt) {
            if (reply->starts_with("ok"))
                return reply->substr(std::min<std::size_t>(3, reply->size()));
            if (reply->starts_with("error "))
                throw std::runtime_error(reply->substr(6));
        }
        kill(-process_, SIGKILL);
        stop();
        start();
        for (std::optional<std::string> greeting; (greeting = line()) && *greeting != "ready";) {
        }
        throw std::runtime_error("its process ended, or did not answer");
    }

    const fs::path& scratch() const { return scratch_; }

private:
    void start() {
        int requests[2], replies[2];
        if (pipe2(requests, O_CLOEXEC) != 0 || pipe2(replies, O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe to a child process");
        process_ = fork();
        if (process_ == 0) {
            setpgid(0, 0);  // what it starts ends with it
            dup2(requests[0], STDIN_FILENO);
            dup2(replies[1], STDOUT_FILENO);
            execl("/bin/sh", "sh", "-c", command_.c_str(), static_cast<char*>(nullptr));
            _exit(127);
        }
        close(requests[0]);
        close(replies[1]);
        in_ = requests[1];
        out_ = replies[0];
        unread_.clear();
    }

    /// The end of its input is the end of it.
    void stop() {
        close(in_);
        close(out_);
        waitpid(process_, nullptr, 0);
    }

    std::string command_;
    pid_t process_ = -1;
    int in_ = -1, out_ = -1;
    std::string unread_;
    fs::path scratch_;
};

std::string textOf(const asset::View& view) {
    const glm::dmat3x2& m = view.toPixels;
    return fmt::format("{} {} {} {} {} {} {} {}", view.width, view.height, m[0][0], m[0][1], m[1][0], m[1][1],
                       m[2][0], m[2][1]);
}

/// Paths of one colour each, or of gradients too, in groups that have an opacity at most.
bool arePaths(const scene::Group& group, bool withGradients) {
    const auto isPath = [&](const scene::Node& node) {
        if (const auto* inner = std::get_if<scene::Group>(&node.value))
            return arePaths(*inner, withGradients);
        const auto* item = std::get_if<scene::Item>(&node.value);
        return item && (std::holds_alternative<scene::Color>(item->paint) ||
                        (withGradients && (std::holds_alternative<scene::LinearGradient>(item->paint) ||
                                           std::holds_alternative<scene::RadialGradient>(item->paint))));
    };
    return group.blend == scene::BlendMode::Normal && !group.clip && !group.mask &&
           std::ranges::all_of(group.children, isPath);
}

class ChildEngine : public Engine {
public:
    /// `takes`: "file"; "paths" (ours, plain) or "gradients" (the same, painted with them too); or "either"
    /// (paths where our scene has no more than that).
    ChildEngine(std::shared_ptr<Child> child, std::string name, std::string description, std::string takes)
        : Engine(std::move(name), std::move(description)),
          child_(std::move(child)),
          takes_(std::move(takes)) {}

    void load(const LoadedFile& picture) override {
        written_.reset();
        const bool ours = readsPaths() || (takes_ == "either" && arePaths(picture.scene.root, false));
        child_->ask("load " + subject(picture, ours ? writePaths(picture) : picture.file.path.string()));
    }

    double draw(const asset::View& view) override {
        return std::stod(child_->ask("draw " + name() + " " + textOf(view)));
    }

    std::optional<double> drawCold(const LoadedFile& picture, const asset::View& view) override {
        const std::string path = readsPaths() ? writePaths(picture) : picture.file.path.string();
        return std::stod(child_->ask("cold " + subject(picture, textOf(view) + " " + path)));
    }

    image::Bitmap pixels(const asset::View& view) override {
        const fs::path png = child_->scratch() / "drawn.png";
        child_->ask("picture " + name() + " " + textOf(view) + " " + png.string());
        return image::decode(image::readFile(png.string()));
    }

    std::optional<double> peakBytes() override { return std::stod(child_->ask("peak " + name())); }

private:
    std::string subject(const LoadedFile& picture, const std::string& rest) const {
        return fmt::format("{} {} {} {}", name(), picture.scene.width, picture.scene.height, rest);
    }

    /// And no files of others.
    bool readsPaths() const { return takes_ == "paths" || takes_ == "gradients"; }

    /// The path of a file with the paths of our scene, which is written once for all cold drawings.
    std::string writePaths(const LoadedFile& picture) {
        const bool withGradients = takes_ == "gradients";
        if (!arePaths(picture.scene.root, withGradients))
            throw std::runtime_error(withGradients
                                         ? "it is given paths alone, painted with colours and gradients"
                                         : "it is given paths alone, painted with colours");
        const std::string path = (child_->scratch() / (name() + ".svg")).string();
        if (written_ != picture.file.path) {
            const std::string text = svg::write(picture.scene, {.shared = false});
            image::writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
            written_ = picture.file.path;
        }
        return path;
    }

    std::shared_ptr<Child> child_;
    std::string takes_;
    std::optional<fs::path> written_;  ///< the file whose paths writePaths has written
};

/// "engine NAME TAKES DESCRIPTION"
std::unique_ptr<Engine> engineOf(const std::string& line, const std::shared_ptr<Child>& child) {
    std::istringstream in(line);
    std::string word, name, takes, description;
    in >> word >> name >> takes;
    std::getline(in >> std::ws, description);
    return std::make_unique<ChildEngine>(child, name, description, takes);
}

}  // namespace

Engines childEngines(const std::string& command, std::vector<std::string>& notes) {
    Engines engines;
    const auto child = std::make_shared<Child>(command);
    while (const std::optional<std::string> line = child->line()) {
        if (line->starts_with("engine "))
            engines.push_back(engineOf(*line, child));
        else if (line->starts_with("missing "))
            notes.push_back(line->substr(8));
        else if (*line == "ready")
            return engines;
    }
    notes.push_back(fmt::format("missing: `{}` did not start.", command));
    return {};
}

}  // namespace vtm::bench
