pytest_plugins = ["course.checks.plugin"]
