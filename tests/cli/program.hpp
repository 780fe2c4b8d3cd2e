// SPDX-License-Identifier: GPL-3.0-or-later

// The real program in a temporary folder.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace haff::tests {

// The program `campaign` of this build.
extern const char* const campaign_path;

// A temporary folder, which holds the store of the test.
class Folder {
 public:
  std::filesystem::path operator/(const std::string& name) const { return folder_.path() / name; }
  std::filesystem::path store() const { return *this / "campaign.db"; }
  void write(const std::string& name, const std::string& text) const;

 private:
  TemporaryFolder folder_;
};

struct Outcome {
  int exit_code = 0;  // 128 + signal if a signal killed it
  std::string out, err;
  double peak_bytes = 0;  // the largest memory that it used
};

// A program that runs in a folder: `campaign`, or the program whose path is the first word.
class Program {
 public:
  Program(const Folder& folder, std::vector<std::string> words);
  ~Program();  // kills it if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t id() const { return id_; }
  bool runs() const;
  std::vector<pid_t> workers() const;  // its child processes
  void signal(int number) const;
  Outcome wait();

 private:
  const Folder& folder_;
  std::string output_;
  pid_t id_ = 0;
};

// Runs `campaign` with these arguments to its end.
Outcome campaign(const Folder& folder, std::vector<std::string> words);

// Runs a shell script in the folder, where $campaign is the program.
Outcome shell(const Folder& folder, const std::string& script);

bool is_alive(pid_t process);
void sleep_for(std::chrono::milliseconds time);

// Every row of samples, profiles, fields, snapshots and results with the physics of its job, reals
// in hexadecimal: equal texts are equal bits.
std::string rows(const Folder& folder);

// The number that a query gives.
double number(const Folder& folder, const std::string& sql);

// Changes the store behind the program's back.
void edit_rows(const Folder& folder, const std::string& sql);

// The same as by a program without digests, so that the change is not noticed.
void edit_unnoticed(const Folder& folder, const std::string& sql);

}  // namespace haff::tests
