/// \file
/// Where the command writes: files, whole or not at all, or standard output. What is refused, is refused
/// before anything is drawn.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vtm::tools {

/// "-" and /dev/stdout.
bool isStandardOutput(const std::string& output);

/// A file, there or not yet: not standard output, a device or a pipe.
bool isRegularOutput(const std::string& output);

/// Throws UsageError if the output is a file whose name ends in none of `suffixes` (".png", any case). A name
/// without a suffix is taken as it is, and what a device or a pipe is called says nothing.
void requireSuffix(const std::string& output, std::initializer_list<std::string_view> suffixes);

/// Throws UsageError if two outputs are one file, or one of them is one of the inputs, under whatever name;
/// or if something binary would go to a terminal.
void refuseLoss(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Throws UsageError if a result and figures (of the option `figures`) both go to standard output.
void refuseMixture(const std::string& output, std::string_view figures);

/// Throws image::CodecError, StandardOutputError.
void writeOutput(const std::string& output, std::span<const std::uint8_t> bytes);

/// At once, without a buffer. Throw StandardOutputError.
void print(std::string_view text);
void print(std::span<const std::uint8_t> bytes);

bool standardOutputIsTerminal();

}  // namespace vtm::tools
