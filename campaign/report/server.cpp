// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/report/server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "campaign/base/process/signals.hpp"
#include "campaign/base/text/error_text.hpp"
#include "campaign/report/page.hpp"
#include "schema/store/store.hpp"

namespace haff::campaign {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* host = "127.0.0.1";

// Reading the store for the page may take at most this part of the time, however many browsers ask.
constexpr double share_of_reading = 0.05;

constexpr std::size_t most_browsers = 8;  // that are answered at a time
constexpr time_t idle_connection = 1;     // is closed after this [s]
constexpr std::chrono::milliseconds look_for_signals{100};

// An answer that is given again until it is worth making a new one.
class Kept {
 public:
  template <class Make>
  std::string get(Make&& make) {
    const std::lock_guard lock(mutex_);
    const auto before = Clock::now();
    if (!text_ || before >= stale_) {
      text_ = make();
      const auto now = Clock::now();
      stale_ = now + std::chrono::duration_cast<Clock::duration>((now - before) / share_of_reading);
    }
    return *text_;
  }

 private:
  std::mutex mutex_;
  std::optional<std::string> text_;
  Clock::time_point stale_;
};

// 128 bits as hexadecimal digits.
std::string new_token() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 4; ++k) token += fmt::format("{:08x}", static_cast<unsigned>(random()));
  return token;
}

std::string averages(const schema::Reader& store) {
  const std::vector<std::byte> bytes = page_tables(store);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class ReportServer {
 public:
  explicit ReportServer(std::filesystem::path path) : store_(std::move(path)) {
    // Not SO_REUSEPORT, the library's own choice: another process could then listen on our port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    server_.new_task_queue = [] { return new httplib::ThreadPool(most_browsers); };
    server_.set_keep_alive_timeout(idle_connection);
    server_.set_default_headers({{"Cache-Control", "no-store"},
                                 {"Referrer-Policy", "no-referrer"},
                                 {"X-Content-Type-Options", "nosniff"},
                                 {"X-Frame-Options", "DENY"}});
    server_.set_error_handler([](const httplib::Request&, httplib::Response& answer) {
      if (answer.body.empty())
        answer.set_content(
            "There is nothing here. The address is the one that campaign report "
            "printed, with all that follows the port.\n",
            "text/plain");
    });
    server_.set_exception_handler(
        [](const httplib::Request&, httplib::Response& answer, std::exception_ptr thrown) {
          answer.status = 500;
          try {
            std::rethrow_exception(std::move(thrown));
          } catch (const std::exception& error) {
            answer.set_content(error_text(error), "text/plain; charset=utf-8");
          }
        });
    offer("/", page_, "text/html; charset=utf-8",
          [](const schema::Reader& store) { return report_page(store, true); });
    offer("/data.json", data_, "application/json", page_data);
    offer("/averages.db", averages_, "application/vnd.sqlite3", averages);
  }

  // The address, once the port is ours.
  std::string bind(int port) {
    if (port == 0)
      port = server_.bind_to_any_port(host);
    else if (!server_.bind_to_port(host, port))
      port = -1;
    if (port < 0)
      throw std::runtime_error(
          "the port cannot be listened on: another program has it, or it is below 1024; name "
          "another one, or none for any that is free");
    return fmt::format("http://{}:{}/{}/", host, port, token_);
  }

  void answer_until_stopped() {
    std::thread listener([this] { server_.listen_after_bind(); });
    while (stop_signal() == 0) std::this_thread::sleep_for(look_for_signals);
    server_.stop();
    listener.join();
  }

 private:
  template <class Make>
  void offer(const std::string& name, Kept& kept, const char* type, Make make) {
    server_.Get("/" + token_ + name,
                [this, &kept, type, make](const httplib::Request&, httplib::Response& answer) {
                  answer.set_content(kept.get([&] { return make(schema::Reader(store_)); }), type);
                });
  }

  std::filesystem::path store_;
  std::string token_ = new_token();
  Kept page_, data_, averages_;
  httplib::Server server_;
};

}  // namespace

void serve_report(const std::filesystem::path& store, int port,
                  const std::function<void(const std::string& address)>& ready) {
  report_page(schema::Reader(store), true);  // what cannot be read is said at once
  ReportServer server(store);
  const std::string address = server.bind(port);
  ready(address);
  server.answer_until_stopped();
}

}  // namespace haff::campaign
