pytest_plugins = ["labkit.checks.plugin"]
