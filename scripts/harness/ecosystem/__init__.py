"""The contact in other people's libraries."""
