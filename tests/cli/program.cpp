// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/program.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

namespace haff::tests {

const char* const campaign_path = HAFF_CAMPAIGN;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void redirect(const std::string& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, descriptor);
  close(file);
}

std::string hexadecimal(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%a", value);
  return text.data();
}

// The state letter and the parent of a process, from proc(5).
std::pair<char, pid_t> state_and_parent(const std::string& process) {
  const std::string stat = text_of("/proc/" + process + "/stat");
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return {'X', 0};
  std::istringstream fields(stat.substr(name_end + 1));
  char state = 'X';
  pid_t parent = 0;
  fields >> state >> parent;
  return {state, parent};
}

}  // namespace

void Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(*this / name) << text;
}

Program::Program(const Folder& folder, std::vector<std::string> words) : folder_(folder) {
  static int number = 0;
  output_ = "output-" + std::to_string(number++);
  if (words.front().find('/') == std::string::npos) words.insert(words.begin(), campaign_path);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string place = (folder / "").string();
  id_ = fork();
  if (id_ != 0) return;
  if (chdir(place.c_str()) != 0) _exit(126);
  redirect(output_ + ".out", STDOUT_FILENO);
  redirect(output_ + ".err", STDERR_FILENO);
  setenv("campaign", campaign_path, 1);
  execv(arguments.front(), arguments.data());
  _exit(127);
}

Program::~Program() {
  if (id_ <= 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

bool Program::runs() const {
  return is_alive(id_);
}

std::vector<pid_t> Program::workers() const {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto [state, parent] = state_and_parent(name);
    if (parent == id_ && state != 'Z' && state != 'X') children.push_back(std::stoi(name));
  }
  return children;
}

void Program::signal(int number) const {
  if (id_ > 0) kill(id_, number);
}

Outcome Program::wait() {
  int status = 0;
  rusage used{};
  while (wait4(id_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  id_ = 0;
  return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
          text_of(folder_ / (output_ + ".out")), text_of(folder_ / (output_ + ".err")),
          1024.0 * static_cast<double>(used.ru_maxrss)};
}

Outcome campaign(const Folder& folder, std::vector<std::string> words) {
  return Program(folder, std::move(words)).wait();
}

Outcome shell(const Folder& folder, const std::string& script) {
  return Program(folder, {"/bin/sh", "-c", script}).wait();
}

bool is_alive(pid_t process) {
  const char state = state_and_parent(std::to_string(process)).first;
  return state != 'Z' && state != 'X';
}

void sleep_for(std::chrono::milliseconds time) {
  std::this_thread::sleep_for(time);
}

std::string rows(const Folder& folder) {
  const SQLite::Database store(folder.store().string(), SQLite::OPEN_READONLY, 10'000);
  const auto text = [&](const char* sql) {
    SQLite::Statement statement(store, sql);
    std::string all;
    while (statement.executeStep()) {
      for (int c = 0; c < statement.getColumnCount(); ++c) {
        const SQLite::Column value = statement.getColumn(c);
        all += value.isFloat() ? hexadecimal(value.getDouble()) : value.getString();
        all += value.isNull() ? "NULL " : " ";
      }
      all += '\n';
    }
    return all;
  };
  return text(
             "SELECT identity, samples.tau, time, temperature, gamma_ratio, collision_rate, "
             "pressure, a2, a3, a4, a5, a6, correlation_trace, largest_cluster FROM samples JOIN "
             "jobs USING (job_id) "
             "ORDER BY identity, samples.tau") +
         text(
             "SELECT identity, name, profiles.tau, x, value FROM profiles JOIN jobs USING (job_id) "
             "ORDER BY identity, name, profiles.tau, x") +
         text(
             "SELECT identity, name, fields.tau, cells, components, box, hex(data) "
             "FROM fields JOIN jobs USING (job_id) ORDER BY identity, name, fields.tau") +
         text(
             "SELECT identity, time, snapshots.tau, snapshots.collisions, position, "
             "hex(snapshot_chunks.bytes) FROM snapshots JOIN snapshot_chunks USING (job_id, time) "
             "JOIN jobs USING (job_id) ORDER BY identity, time, position") +
         text(
             "SELECT identity, results.* FROM jobs JOIN (SELECT job_id, tau_c, time_c FROM "
             "results) "
             "AS results USING (job_id) ORDER BY identity");
}

double number(const Folder& folder, const std::string& sql) {
  const SQLite::Database store(folder.store().string(), SQLite::OPEN_READONLY, 10'000);
  SQLite::Statement statement(store, sql);
  REQUIRE(statement.executeStep());
  return statement.getColumn(0).getDouble();
}

void edit_rows(const Folder& folder, const std::string& sql) {
  SQLite::Database store(folder.store().string(), SQLite::OPEN_READWRITE, 10'000);
  store.exec(sql);
}

void edit_unnoticed(const Folder& folder, const std::string& sql) {
  edit_rows(folder, sql +
                        "; DELETE FROM table_digests; DELETE FROM digests; "
                        "INSERT INTO digests (job_id) SELECT job_id FROM jobs");
}

}  // namespace haff::tests
