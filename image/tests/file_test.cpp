// Files: whole or not at all, links, permissions, pipes.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vtm/image/codec.hpp>

#include "tests/test_folder.hpp"

namespace vtm::image {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

class Files : public testing::Test {
protected:
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t count() const {
        return std::size_t(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
    }
    static mode_t modeOf(const std::string& path) {
        struct stat status {};
        EXPECT_EQ(stat(path.c_str(), &status), 0);
        return status.st_mode & 07777;
    }
    std::string messageOf(const std::string& path) const {
        try {
            writeFile(path, old_);
        } catch (const CodecError& error) {
            return error.what();
        }
        return "";
    }

    const TestFolder folder_;
    const Bytes old_{1, 2, 3}, new_{4, 5, 6, 7};
};

TEST_F(Files, AreReplacedAndNothingIsLeftBeside) {
    writeFile(at("a"), old_);
    writeFile(at("a"), new_);
    EXPECT_EQ(readFile(at("a")), new_);
    EXPECT_EQ(count(), 1u);
}

TEST_F(Files, EmptyOnesCanBeWrittenAndRead) {
    writeFile(at("a"), {});
    EXPECT_TRUE(readFile(at("a")).empty());
}

TEST_F(Files, NewOnesHaveTheUsualPermissions) {
    const mode_t mask = umask(027);
    writeFile(at("a"), old_);
    umask(mask);
    EXPECT_EQ(modeOf(at("a")), 0640u);
}

TEST_F(Files, OldOnesKeepTheirs) {
    writeFile(at("a"), old_);
    for (const mode_t mode : {0600u, 0664u, 0777u}) {
        ASSERT_EQ(chmod(at("a").c_str(), mode), 0);
        writeFile(at("a"), new_);
        EXPECT_EQ(modeOf(at("a")), mode);
    }
}

TEST_F(Files, LinksStayAndTheirTargetIsReplaced) {
    fs::create_directory(folder_ / "deep");
    writeFile(at("deep/target"), old_);
    fs::create_symlink("deep/target", at("link"));
    fs::create_symlink("link", at("second"));
    writeFile(at("second"), new_);
    EXPECT_TRUE(fs::is_symlink(at("second")));
    EXPECT_TRUE(fs::is_symlink(at("link")));
    EXPECT_FALSE(fs::is_symlink(at("deep/target")));
    EXPECT_EQ(readFile(at("deep/target")), new_);
}

TEST_F(Files, LinksToNothingMakeTheirTarget) {
    fs::create_symlink("later", at("link"));
    writeFile(at("link"), new_);
    EXPECT_TRUE(fs::is_symlink(at("link")));
    EXPECT_EQ(readFile(at("later")), new_);
}

TEST_F(Files, LinksInACircleAreAnError) {
    fs::create_symlink("b", at("a"));
    fs::create_symlink("a", at("b"));
    EXPECT_NE(messageOf(at("a")).find("a: cannot be written: "), std::string::npos);
}

TEST_F(Files, OtherHardLinksKeepTheOldContent) {
    writeFile(at("a"), old_);
    fs::create_hard_link(at("a"), at("b"));
    writeFile(at("a"), new_);
    EXPECT_EQ(readFile(at("a")), new_);
    EXPECT_EQ(readFile(at("b")), old_);
}

TEST_F(Files, PipesAreWrittenThroughAndRead) {
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    const Bytes large(300'000, 9);  // more than a pipe holds
    Bytes got;
    std::thread reader([&] { got = readFile(at("pipe")); });
    writeFile(at("pipe"), large);
    reader.join();
    EXPECT_EQ(got, large);
    EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

TEST_F(Files, DevicesAreWrittenThrough) {
    EXPECT_EQ(messageOf("/dev/null"), "");
    EXPECT_NE(messageOf("/dev/full").find("/dev/full: cannot be written: No space left"), std::string::npos);
    fs::create_symlink("/dev/full", at("link"));
    EXPECT_NE(messageOf(at("link")).find("No space left"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, DescriptorsByNameAreWrittenThrough) {
    if (!fs::exists("/proc/self/fd"))
        GTEST_SKIP() << "/proc is not mounted";
    writeFile(at("a"), old_);
    const int file = open(at("a").c_str(), O_RDWR);
    ASSERT_GE(file, 0);
    writeFile("/proc/self/fd/" + std::to_string(file), new_);
    EXPECT_EQ(readStream(file, "the open file"), new_);
    close(file);
}

TEST_F(Files, ErrorsNameThePathAndTheCause) {
    EXPECT_NE(
        messageOf(at("none/a"))
            .find("none/a: cannot be written: cannot create a temporary file in its directory: No such"),
        std::string::npos);
    EXPECT_NE(messageOf(folder_.path().string()).find("Is a directory"), std::string::npos);
    EXPECT_NE(messageOf(at(std::string(300, 'a'))).find("File name too long"), std::string::npos);
}

/// A limit that ends with the test.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit lower{bytes, old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &lower);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    void (*handler_)(int);
    rlimit old_{};
};

TEST_F(Files, WhatCannotBeWrittenWholeLeavesTheOldFile) {
    writeFile(at("a"), old_);
    std::string message;
    {
        const FileSizeLimit limit(1000);
        try {
            writeFile(at("a"), Bytes(5000, 8));
        } catch (const CodecError& error) {
            message = error.what();
        }
    }
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
    EXPECT_EQ(readFile(at("a")), old_);
    EXPECT_EQ(count(), 1u);
}

TEST_F(Files, TheLongestNameCanBeWritten) {
    const std::string name(255, 'n');
    writeFile(at(name), new_);
    EXPECT_EQ(readFile(at(name)), new_);
}

TEST_F(Files, StreamsSayWhatFailed) {
    const int full = open("/dev/full", O_WRONLY);
    EXPECT_EQ(writeStream(full, new_), ENOSPC);
    close(full);
    EXPECT_EQ(writeStream(full, new_), EBADF);
    EXPECT_THROW(readStream(full, "a closed one"), CodecError);
}

}  // namespace
}  // namespace vtm::image
